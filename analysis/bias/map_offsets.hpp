#pragma once

#include "methods/polygon_offset.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/depth/offset_unit.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What a polygon offset adds to the depths of a map, texel by texel.
///
/// factor · m is what the driver did: the difference of two maps of 32-bit floats, drawn with and
/// without the factor. Where they do not both show the triangle in question, it is the formula's.
/// To it comes units · r, r the driver's unit in the job's format, and the clamp limits the sum.
class MapOffsets {
public:
    /// Draws both maps.
    /// @param triangles  must outlive this.
    MapOffsets(const methods::PolygonOffset& offset, const scene::Job& job, const scene::View& view,
               const scene::TriangleScene& triangles, renderers::Rasterizer& rasterizer);

    /// What is added where a triangle is seen at a depth, whose sum stays in [0, 1]; depth units.
    [[nodiscard]] double at(const scene::Texel& texel, std::uint32_t triangle, double depth) const;
    /// The same of a receiver's own plane, by the formula.
    [[nodiscard]] double at_receiver(int map, std::uint32_t triangle, double depth) const;
    /// The same of what the map without offset shows there; 0 at the farthest depth, which nothing
    /// has.
    [[nodiscard]] double at(const scene::Texel& texel, double depth) const;

private:
    [[nodiscard]] double limited(double of_factor, double depth) const;
    /// factor · m, by the formula.
    [[nodiscard]] double of_plane(int map, std::uint32_t triangle) const;
    /// factor · m
    [[nodiscard]] double of_factor(const scene::Texel& texel, std::uint32_t triangle) const;

    methods::PolygonOffset offset_;
    scene::DepthFormat format_;
    std::vector<scene::LightFrustum> maps_;
    int resolution_texels_;
    const scene::TriangleScene* triangles_;
    std::vector<scene::OffsetUnit> units_;
    scene::Image<float> drawn_;               ///< factor · m; empty without a factor
    scene::Image<std::uint32_t> shown_;       ///< without the factor; likewise
    scene::Image<std::uint8_t> are_the_same_; ///< 1 where it is shown with the factor, too
};

/// Those of the job's map; empty where it is drawn without offset.
[[nodiscard]] std::optional<MapOffsets> find_map_offsets(const scene::Job& job,
                                                         const scene::View& view,
                                                         const scene::TriangleScene& triangles,
                                                         renderers::Rasterizer& rasterizer);

} // namespace gnomon::analysis
