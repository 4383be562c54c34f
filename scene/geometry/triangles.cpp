#include "scene/geometry/triangles.hpp"

#include "scene/error.hpp"
#include "scene/fnv1a.hpp"
#include "scene/text.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gnomon::scene {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Corner = std::array<std::uint32_t, 3>;

constexpr double unit_roundoff = 0x1p-53;

/// A coordinate as both renderers see it: float32 without subnormals and negative zero (adding +0
/// turns −0 into +0), so that equal points are bit-equal.
float canonical(double value)
{
    const auto rounded = static_cast<float>(value);
    return std::fpclassify(rounded) == FP_SUBNORMAL ? 0.0F : rounded + 0.0F;
}

Vec3f canonical_vertex(const Vec3d& vertex, std::string_view object, std::size_t index)
{
    Vec3f result;
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(vertex[axis]) || std::abs(vertex[axis]) > max_coordinate_m) {
            throw InputError(fmt::format(
                "object \"{}\", vertex {}: the {} coordinate is {}: coordinates must be finite and "
                "within ±1e15; repair or scale the mesh",
                object, index, "xyz"[axis], vertex[axis]));
        }
        result[axis] = canonical(vertex[axis]);
    }
    return result;
}

/// Whether u·v − s·t is zero, with exact rationals.
bool is_zero_exactly(double a, double b, double c, double d, double e, double f, double g, double h)
{
    const auto difference = [](double x, double y) { return Rational{x} - Rational{y}; };
    return difference(a, b) * difference(c, d) == difference(e, f) * difference(g, h);
}

/// Whether (b − a) × (c − a) is exactly zero. Decided in double if the error bound allows. Each
/// component is a difference of two products of differences, with at most 5 roundings on each path,
/// so its error is below 6u times the sum of the absolute products.
bool has_zero_area(const Vec3f& a, const Vec3f& b, const Vec3f& c)
{
    const Vec3d p{a};
    const Vec3d q{b};
    const Vec3d r{c};
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3;
        const int j = (axis + 2) % 3;
        const double plus = (q[i] - p[i]) * (r[j] - p[j]);
        const double minus = (q[j] - p[j]) * (r[i] - p[i]);
        if (std::abs(plus - minus) > 6 * unit_roundoff * (std::abs(plus) + std::abs(minus))) {
            return false;
        }
        if (!is_zero_exactly(q[i], p[i], r[j], p[j], q[j], p[j], r[i], p[i])) {
            return false;
        }
    }
    return true;
}

std::vector<TriangleRange> ranges_where(const TriangleScene& scene, bool Object::*role)
{
    std::vector<TriangleRange> ranges;
    for (const Object& object : scene.objects) {
        if (!(object.*role) || object.triangle_count == 0) {
            continue;
        }
        if (!ranges.empty() && ranges.back().first + ranges.back().count == object.first_triangle) {
            ranges.back().count += object.triangle_count;
        } else {
            ranges.push_back({object.first_triangle, object.triangle_count});
        }
    }
    return ranges;
}

void clear_role(TriangleScene& scene, bool Object::*role, std::span<const std::string> names,
                std::string_view key)
{
    for (const std::string& name : names) {
        bool found = false;
        std::vector<std::string> candidates;
        for (Object& object : scene.objects) {
            candidates.push_back(object.name);
            if (object.name == name) {
                object.*role = false;
                found = true;
            }
        }
        if (!found) {
            throw InputError(fmt::format(
                "{} = [\"{}\"]: the scene has no object of this name; the nearest is \"{}\"", key,
                name, nearest_word(name, candidates)));
        }
    }
}

/// The name, with a number from 2 on if it is taken.
std::string free_name(const TriangleScene& scene, const std::string& wanted)
{
    const auto is_taken = [&](const std::string& name) {
        return std::ranges::find(scene.objects, name, &Object::name) != scene.objects.end();
    };
    std::string name = wanted;
    for (int number = 2; is_taken(name); ++number) {
        name = fmt::format("{}.{}", wanted, number);
    }
    return name;
}

/// Gives triangles without corner attributes empty ones if others have some.
void fill_up_attributes(TriangleScene& scene)
{
    if (!scene.attributes.empty()) {
        scene.attributes.resize(scene.triangles.size());
    }
}

/// Adds the other scene's objects unchanged. They have no corner attributes.
void append(TriangleScene& scene, const TriangleScene& other)
{
    const auto offset = static_cast<std::uint32_t>(scene.vertices.size());
    const auto first = static_cast<std::uint32_t>(scene.triangles.size());
    scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Corner& corner : other.triangles) {
        scene.triangles.push_back({corner[0] + offset, corner[1] + offset, corner[2] + offset});
    }
    for (Object object : other.objects) {
        object.first_triangle += first;
        scene.objects.push_back(std::move(object));
    }
    fill_up_attributes(scene);
}

} // namespace

double Box::diagonal_m() const
{
    return glm::length(upper - lower);
}

std::array<Vec3d, 8> Box::corners() const
{
    std::array<Vec3d, 8> result;
    for (unsigned i = 0; i < 8; ++i) {
        result[i] = {(i & 1U) != 0 ? upper.x : lower.x, (i & 2U) != 0 ? upper.y : lower.y,
                     (i & 4U) != 0 ? upper.z : lower.z};
    }
    return result;
}

std::size_t TriangleScene::object_of(std::uint32_t triangle) const
{
    const auto after = std::upper_bound(
        objects.begin(), objects.end(), triangle,
        [](std::uint32_t index, const Object& object) { return index < object.first_triangle; });
    return static_cast<std::size_t>(after - objects.begin()) - 1;
}

Box TriangleScene::bounds() const
{
    if (triangles.empty()) {
        throw InputError("the scene has no triangle: there is nothing to shadow");
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box box{Vec3d{infinity}, Vec3d{-infinity}};
    for (const Vec3f& vertex : vertices) {
        box.lower = glm::min(box.lower, Vec3d{vertex});
        box.upper = glm::max(box.upper, Vec3d{vertex});
    }
    return box;
}

std::vector<TriangleRange> casting_ranges(const TriangleScene& scene)
{
    return ranges_where(scene, &Object::casts);
}

std::vector<TriangleRange> receiving_ranges(const TriangleScene& scene)
{
    return ranges_where(scene, &Object::receives);
}

std::vector<std::uint32_t>
SceneBuilder::add(std::string_view name, std::span<const Vec3d> vertices,
                  std::span<const std::array<std::uint32_t, 3>> triangles,
                  std::span<const TriangleAttributes> attributes)
{
    if (triangles.empty()) {
        return {};
    }
    if (!attributes.empty() && attributes.size() != triangles.size()) {
        throw std::invalid_argument("SceneBuilder::add: there must be attributes of each triangle");
    }
    if (scene_.triangles.size() + triangles.size() >= no_triangle ||
        scene_.vertices.size() + vertices.size() >= no_triangle) {
        throw InputError(fmt::format(
            "object \"{}\": the scene exceeds 4294967294 triangles or vertices; split it", name));
    }
    std::vector<Vec3f> rounded(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        rounded[i] = canonical_vertex(vertices[i], name, i);
    }
    const auto first = static_cast<std::uint32_t>(scene_.triangles.size());
    std::vector<std::uint32_t> new_index(vertices.size(), no_triangle);
    std::vector<std::uint32_t> kept;
    kept.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Corner& corner = triangles[t];
        for (const std::uint32_t index : corner) {
            if (index >= vertices.size()) {
                throw InputError(fmt::format(
                    "object \"{}\", triangle {}: vertex index {} of {} vertices; repair the mesh",
                    name, t, index, vertices.size()));
            }
        }
        if (has_zero_area(rounded[corner[0]], rounded[corner[1]], rounded[corner[2]])) {
            continue;
        }
        kept.push_back(static_cast<std::uint32_t>(t));
        Corner placed{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& slot = new_index[corner[k]];
            if (slot == no_triangle) {
                slot = static_cast<std::uint32_t>(scene_.vertices.size());
                scene_.vertices.push_back(rounded[corner[k]]);
            }
            placed[k] = slot;
        }
        scene_.triangles.push_back(placed);
        if (!attributes.empty()) {
            scene_.attributes.resize(scene_.triangles.size()); // earlier objects may have none
            scene_.attributes.back() = attributes[t];
        }
    }
    const auto count = static_cast<std::uint32_t>(kept.size());
    const auto flat = static_cast<std::uint32_t>(triangles.size() - kept.size());
    scene_.dropped_triangles += flat;
    scene_.objects.push_back({std::string{name}, first, count});
    scene_.objects.back().flat_triangles = flat;
    return kept;
}

TriangleScene SceneBuilder::take()
{
    scene_.vertices.shrink_to_fit(); // they grew by doubling
    scene_.triangles.shrink_to_fit();
    fill_up_attributes(scene_);
    scene_.attributes.shrink_to_fit();
    return std::exchange(scene_, {});
}

void add_ground(TriangleScene& scene)
{
    const Box box = scene.bounds();
    const Vec3d centre = box.centre();
    const double half_side = 1.5 * box.diagonal_m();
    const std::array<Vec3d, 4> vertices{
        Vec3d{centre.x - half_side, box.lower.y, centre.z + half_side},
        Vec3d{centre.x + half_side, box.lower.y, centre.z + half_side},
        Vec3d{centre.x + half_side, box.lower.y, centre.z - half_side},
        Vec3d{centre.x - half_side, box.lower.y, centre.z - half_side}};
    const std::array<Corner, 2> triangles{Corner{0, 1, 2}, Corner{0, 2, 3}};
    SceneBuilder builder;
    builder.add(free_name(scene, "ground"), vertices, triangles);
    append(scene, builder.take());
}

void set_roles(TriangleScene& scene, std::span<const std::string> no_cast,
               std::span<const std::string> no_receive)
{
    clear_role(scene, &Object::casts, no_cast, "scene.no_cast");
    clear_role(scene, &Object::receives, no_receive, "scene.no_receive");
}

std::string content_hash(const TriangleScene& scene)
{
    Fnv1a hash;
    hash.add(scene.vertices.data(), scene.vertices.size() * sizeof(Vec3f));
    hash.add(scene.triangles.data(), scene.triangles.size() * sizeof(Corner));
    for (const Object& object : scene.objects) {
        const std::array<std::uint32_t, 4> facts{object.first_triangle, object.triangle_count,
                                                 object.casts ? 1U : 0U, object.receives ? 1U : 0U};
        hash.add(object.name);
        hash.add(facts.data(), sizeof facts);
    }
    return fmt::format("{:016x}", hash.value());
}

} // namespace gnomon::scene
