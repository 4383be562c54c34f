#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/settings/job.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::renderers {

/// How precisely first hits are computed.
enum class HitDetail : std::uint8_t {
    bounded, ///< depth within 2^-40, usually much closer
    placed,  ///< depth within 2^-48, and the light distance
};

/// The exact first hit of the light's ray through a texel's centre, between near and far.
struct TexelHit {
    std::uint32_t triangle = scene::no_triangle; ///< the lowest index at this depth
    /// Matrix depth; 1 without a hit (reversed: 0).
    double depth = 1;
    /// Light distance [m] within a relative 2^-44; NaN if only bounded; infinite without a hit.
    double light_distance_m = std::numeric_limits<double>::infinity();
    double depth_error = 0; ///< bound of the error of `depth`
};

/// First hits of other maps of the same light, with equal number, resolution and culling.
struct KnownHits {
    std::span<const scene::LightFrustum> maps;
    std::span<const std::uint32_t> triangles; ///< by texel, or `no_triangle`
};

/// The depth of one tap in a map of infinite precision: of a triangle along a texel-centre ray, or
/// a constant without a hit or where the border mode decides.
struct ExactTap {
    scene::Texel texel;
    std::uint32_t triangle = scene::no_triangle; ///< as `first_hits` found it
    /// As `first_hits` found it; without a triangle a float32 in [0, 1].
    double depth = 1;
    /// As `first_hits` found it. It only makes the answer faster.
    double depth_error = std::numeric_limits<double>::infinity();
    double shift = 0; ///< added to the depth; finite
};

/// How receiver depths are compared.
struct ReceiverRule {
    bool clamps = false; ///< clamps r to [0, 1] first, as border mode `clamp` does
    /// `LookupTerms::moved`: r is the depth of P′, moved nearer to the light; null to use P.
    const scene::Image<scene::Vec4f>* moved = nullptr;
};

/// Compares a receiver with one tap.
struct NearestQuery {
    std::size_t pixel = 0;
    ExactTap tap;
    int map = 0; ///< the map that the pixel reads; beyond a cube's seam the tap is in another
};

/// Compares a receiver with a depth interpolated between four taps, weighted by its exact position
/// between their centres, clamped to them.
struct LinearQuery {
    std::size_t pixel = 0;
    scene::Texel first; ///< lower left tap before clamping, in the map that the pixel reads
    std::array<ExactTap, 4> taps; ///< row by row from there
};

/// A receiver, and the triangle that the light sees at a texel.
struct SelfShadowingQuery {
    std::size_t pixel = 0;
    scene::Texel texel;
    std::uint32_t triangle = 0;
};

/// The blocker of a blocked pixel: the occluder nearest to the light, decided exactly.
struct BlockerHit {
    std::uint32_t triangle = scene::no_triangle;
    double gap_m = 0;                     ///< from P to the blocker, along the segment
    double light_distance_m = 0;          ///< light distance of the blocker [m]
    double receiver_light_distance_m = 0; ///< light distance of P [m]
};

/// Exact answers about the light's rays, for one view, map resolution and culling (docs/causes.md).
///
/// Pixels are row-major indices and must be scored. Texel depths are in the texel's map, receiver
/// depths in the map that the pixel reads. Answers do not depend on the number of threads.
class LightQueries {
public:
    LightQueries() = default;
    LightQueries(const LightQueries&) = delete;
    LightQueries& operator=(const LightQueries&) = delete;
    virtual ~LightQueries() = default;

    /// The first hit of each texel-centre ray with a triangle that is not culled, at a matrix depth
    /// in [0, 1]. A seam is a hit; other degenerate contacts are not.
    /// @param texels  in any order; fastest where sixteen in a row are neighbours, as 4×4.
    /// @return  One hit for each texel.
    [[nodiscard]] virtual std::vector<TexelHit> first_hits(std::span<const scene::Texel> texels,
                                                           HitDetail detail) const = 0;

    /// First hits with `HitDetail::placed`. Known hits speed it up if the frusta differ only in
    /// their near planes and this near plane is not nearer.
    [[nodiscard]] virtual std::vector<TexelHit> first_hits(std::span<const scene::Texel> texels,
                                                           const KnownHits& known) const = 0;

    /// The exact matrix depth of each pixel's P, rounded once to the nearest float32, ties to even;
    /// subnormal results become +0.
    /// @return  One depth for each pixel, within half an ulp. It may be any number or infinite, as
    ///          P need not lie between near and far; NaN for P in the light's camera plane.
    /// @param moved  `LookupTerms::moved`: of P′ in place of P, brought nearer to the light;
    /// nullptr:
    ///               of P itself.
    [[nodiscard]] virtual std::vector<float>
    receiver_depths(std::span<const std::size_t> pixels, const scene::MapIndices& maps,
                    const scene::Image<scene::Vec4f>* moved) const = 0;

    /// The exact position of P on the map that the pixel reads: uv · resolution, rounded down to
    /// float32, which keeps it between the same texel centres and borders.
    /// @param moved  as above.
    /// @return  One position for each pixel; NaN in the light's camera plane.
    [[nodiscard]] virtual std::vector<scene::Vec2f>
    map_places(std::span<const std::size_t> pixels, const scene::MapIndices& maps,
               const scene::Image<scene::Vec4f>* moved) const = 0;
    /// A generous bound of the distance of GL's float32 positions from these [texels]: 256
    /// roundings of the largest terms of any scene point.
    [[nodiscard]] virtual double place_error_texels() const = 0;

    /// The depth of the first hit (`first_hits`) through a given position in each texel, rounded as
    /// `receiver_depths`; 1 without a hit (reversed: 0).
    /// @param texels  in any order; fastest where sixteen in a row are neighbours, as 4×4.
    /// @param place   position in the texel, from its lower left [texels]; `texel_centre`, or in
    ///                [0, 1).
    /// @return  One depth for each texel; [0, 1], within half an ulp.
    [[nodiscard]] virtual std::vector<float> texel_depths(std::span<const scene::Texel> texels,
                                                          const scene::Vec2d& place) const = 0;

    /// The depth of the second hit of each texel-centre ray: the nearest that is exactly farther
    /// than the first. Rounding and the value without a hit are as for `texel_depths`.
    [[nodiscard]] virtual std::vector<float>
    second_depths(std::span<const scene::Texel> texels) const = 0;

    /// For each query the smallest bias B, 0 or a normal float32, for which the exact depths are
    /// lit: r − B <= d (reversed: r + B >= d), with r the exact matrix depth of P and d the tap's.
    /// @return  One bias for each query, of either sign; +∞ for P in the light's camera plane.
    [[nodiscard]] virtual std::vector<float> critical_biases(std::span<const NearestQuery> queries,
                                                             const ReceiverRule& rule) const = 0;
    [[nodiscard]] virtual std::vector<float> critical_biases(std::span<const LinearQuery> queries,
                                                             const ReceiverRule& rule) const = 0;

    /// For each pixel 1 if a triangle that is not culled crosses the open segment P→light, properly
    /// or through a seam, at a matrix depth in [0, 1]; else 0.
    [[nodiscard]] virtual std::vector<std::uint8_t>
    occluded(std::span<const std::size_t> pixels, const scene::MapIndices& maps) const = 0;

    /// As `occluded`, at any depth and with the given culling.
    [[nodiscard]] virtual std::vector<std::uint8_t>
    occluded_anywhere(std::span<const std::size_t> pixels, scene::Cull cull) const = 0;

    /// For each query 1 if the surface continues from P into the triangle seen at the texel, along
    /// the straight line to the texel's centre in light view (docs/truth.md); else 0.
    [[nodiscard]] virtual std::vector<std::uint8_t>
    are_self_shadowing(std::span<const SelfShadowingQuery> queries) const = 0;

    /// The blocker of each blocked pixel among the triangles that are not culled; `no_triangle` if
    /// none of them blocks.
    [[nodiscard]] virtual std::vector<BlockerHit> find_blockers(std::span<const std::size_t> pixels,
                                                                scene::Cull cull) const = 0;
};

} // namespace gnomon::renderers
