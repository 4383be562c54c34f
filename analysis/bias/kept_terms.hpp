#pragma once

#include "methods/polygon_offset.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What a polygon offset adds to the depths of a map, for each texel.
///
/// factor · m is measured: the difference of two float32 maps, drawn with and without the factor.
/// Where they do not both show the triangle in question, it comes from the formula. Adds units · r,
/// with r the driver's unit in the job's format, and clamps the sum.
class MapOffsets {
public:
    /// Draws both maps.
    /// @param triangles  Must outlive this.
    MapOffsets(const methods::PolygonOffset& offset, const scene::Job& job, const scene::View& view,
               const scene::TriangleScene& triangles, renderers::Rasterizer& rasterizer);

    /// The offset of a triangle seen at this depth [depth units]. The moved depth stays in [0, 1].
    [[nodiscard]] double at(const scene::Texel& texel, std::uint32_t triangle, double depth) const;
    /// The offset of the plane of a receiver, from the formula.
    [[nodiscard]] double at_receiver(int map, std::uint32_t triangle, double depth) const;
    /// The offset of the surface that the map without offset shows in this texel; 0 at the farthest
    /// depth, where it shows none.
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
    scene::Image<float> measured_offsets_; ///< factor · m, measured; empty without a factor
    /// Triangle of each texel without the factor; empty without a factor.
    scene::Image<std::uint32_t> shown_triangles_;
    /// 1 where the map with the factor shows the same triangle.
    scene::Image<std::uint8_t> shows_same_triangle_;
};

/// The offsets of the job's map; empty if it is drawn without one.
[[nodiscard]] std::optional<MapOffsets> find_map_offsets(const scene::Job& job,
                                                         const scene::View& view,
                                                         const scene::TriangleScene& triangles,
                                                         renderers::Rasterizer& rasterizer);

/// The bias terms besides constant and slope that V2 keeps for a lit pixel (docs/causes.md).
struct KeptTerms {
    scene::LookupTerms lookup;
    std::optional<MapOffsets> offsets; ///< of the map; empty if it is drawn without one
    bool compares_at_once = false;     ///< GL compares all taps with one depth
    bool is_reversed = false;

    /// What the per-tap terms add to the receiver's depth before it is compared with a tap.
    /// @param centre  Of the tap's texel, before any clamping [texels].
    /// @param point   The point looked up [texels].
    [[nodiscard]] float rise(std::size_t pixel, const scene::Vec2f& centre,
                             const scene::Vec2f& point) const;
};

/// The terms of a job, from known terms and offsets; empty if no such term is active.
[[nodiscard]] std::optional<KeptTerms> make_kept_terms(const scene::Job& job,
                                                       const scene::View& view,
                                                       scene::LookupTerms terms,
                                                       std::optional<MapOffsets> offsets);

/// The terms of a drawn job; empty if no such term is active.
/// @param triangles  Must outlive the result.
[[nodiscard]] std::optional<KeptTerms> find_kept_terms(const scene::Job& job,
                                                       const scene::View& view,
                                                       const scene::TriangleScene& triangles,
                                                       const renderers::Drawn& drawn,
                                                       renderers::Rasterizer& rasterizer);

} // namespace gnomon::analysis
