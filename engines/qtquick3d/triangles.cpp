#include "triangles.hpp"

#include <QByteArray>
#include <QVector3D>

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
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const QVector3D place = corner_at(corners, i);
        const std::size_t first = i - i % 9;
        append(bytes, place);
        append(bytes, QVector3D::normal(corner_at(corners, first), corner_at(corners, first + 3),
                                        corner_at(corners, first + 6)));
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
