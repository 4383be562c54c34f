#pragma once

#include "scene/geometry/triangles.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::scene::test {

/// A report on the edges of an object, with coincident corners merged.
struct EdgeReport {
    std::size_t unmatched_edges = 0; ///< without exactly one partner that runs the other way
    double signed_volume_m3 = 0;     ///< positive if the outside is out; closed objects only
};
[[nodiscard]] EdgeReport check_edges(const TriangleScene& scene, const Object& object);

/// Two triangles in one plane whose interiors overlap.
using Overlap = std::array<std::uint32_t, 2>;
/// Planes are taken as equal when normals differ by less than 1e-5 and offsets by less than 1e-5 m.
[[nodiscard]] std::vector<Overlap> coplanar_overlaps(const TriangleScene& scene);

/// "object/triangle", for messages.
[[nodiscard]] std::string triangle_name(const TriangleScene& scene, std::uint32_t triangle);

} // namespace gnomon::scene::test
