#include "triangles.hpp"

#include "qt_vector.hpp"

#include <QByteArray>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace engine::qt_adapter {
namespace {

constexpr int bytes_of_vector = 3 * sizeof(float);

QVector3D corner_at(const std::vector<float>& corners, std::size_t i)
{
    return {corners[i], corners[i + 1], corners[i + 2]};
}

/// The unit normal of the triangle with its first corner at i; zeros for a degenerate one.
/// QVector3D's normal takes sides of three millimetres for degenerate.
QVector3D normal_at(const std::vector<float>& corners, std::size_t i)
{
    const auto edge_to = [&](std::size_t corner) {
        Vector3 edge{};
        for (std::size_t k = 0; k < 3; ++k) {
            edge[k] = double{corners[corner + k]} - double{corners[i + k]};
        }
        return edge;
    };
    const Vector3 across = cross(edge_to(i + 3), edge_to(i + 6));
    return length(across) > 0 ? qt_vector(normalized(across)) : QVector3D{};
}

void append(QByteArray& bytes, const QVector3D& v)
{
    const std::array<float, 3> numbers{v.x(), v.y(), v.z()};
    bytes.append(reinterpret_cast<const char*>(numbers.data()), bytes_of_vector);
}

} // namespace

Triangles::Triangles(const GlbObject& shape)
{
    const std::vector<float>& corners = shape.corners;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    QVector3D low{infinity, infinity, infinity};
    QVector3D high = -low;
    QByteArray bytes;
    bytes.reserve(static_cast<qsizetype>(corners.size()) * 2 * qsizetype{sizeof(float)});
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const QVector3D place = corner_at(corners, i);
        append(bytes, place);
        append(bytes, normal_at(corners, i - i % 9));
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], place[k]);
            high[k] = std::max(high[k], place[k]);
        }
    }
    setVertexData(bytes);
    setStride(2 * bytes_of_vector);
    setPrimitiveType(PrimitiveType::Triangles);
    addAttribute(Attribute::PositionSemantic, 0, Attribute::F32Type);
    addAttribute(Attribute::NormalSemantic, bytes_of_vector, Attribute::F32Type);
    setBounds(low, high);
}

} // namespace engine::qt_adapter
