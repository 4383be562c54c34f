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

/// How closely first hits are placed.
enum class HitDetail : std::uint8_t {
    bounded, ///< the depth within 2^-40, and as a rule much closer
    placed,  ///< the depth within 2^-48, and the light distance
};

/// What the light sees through a texel's centre: the exact first hit between near and far.
struct TexelHit {
    std::uint32_t triangle = scene::no_triangle; ///< the lowest index of those at this depth
    /// Matrix depth; without a hit the farthest, 1 (reversed: 0).
    double depth = 1;
    /// Light distance [m], to a relative 2^-44, or NaN where only bounded; infinite without a hit.
    double light_distance_m = std::numeric_limits<double>::infinity();
    double depth_error = 0; ///< the exact depth is no farther than this from `depth`
};

/// What other maps of the same light saw first through texels, as many maps of the same resolution
/// and the same culling.
struct KnownHits {
    std::span<const scene::LightFrustum> maps;
    std::span<const std::uint32_t> triangles; ///< by texel, or `no_triangle`
};

/// The depth that one tap of a lookup would find in a map of infinite precision: that of a triangle
/// along a texel-centre ray, or a constant where nothing is seen or the border mode decides.
struct ExactTap {
    scene::Texel texel;
    std::uint32_t triangle = scene::no_triangle; ///< as `first_hits` found it
    /// Without a triangle the depth, a float32 in [0, 1]; else as `first_hits` found it.
    double depth = 1;
    /// As `first_hits` found it. The answer is exact whatever it is, but slow without it.
    double depth_error = std::numeric_limits<double>::infinity();
    double shift = 0; ///< added to the depth; finite
};

/// How receivers are compared.
struct ReceiverRule {
    bool clamps = false; ///< limits r to [0, 1] first, as the border mode `clamp` does
    /// `LookupTerms::moved`: r is the depth of P′, brought nearer to the light; nullptr: P's own.
    const scene::Image<scene::Vec4f>* moved = nullptr;
};

/// One receiver before one tap.
struct NearestQuery {
    std::size_t pixel = 0;
    ExactTap tap;
    int map = 0; ///< that the pixel reads; beyond a cube's seam the tap is of another
};

/// One receiver before a depth interpolated between four taps, weighted by where the receiver
/// exactly is between their centres, or at the nearest place between them.
struct LinearQuery {
    std::size_t pixel = 0;
    scene::Texel first;           ///< of the lower left tap, before any clamping; of the map that
                                  ///< the pixel reads
    std::array<ExactTap, 4> taps; ///< row by row from there
};

/// A receiver, and the triangle seen at a texel.
struct SelfShadowingQuery {
    std::size_t pixel = 0;
    scene::Texel texel;
    std::uint32_t triangle = 0;
};

/// Where the light of a blocked pixel is stopped: at its blocker, the exact one nearest to the
/// light.
struct BlockerHit {
    std::uint32_t triangle = scene::no_triangle;
    double gap_m = 0;                     ///< from P to the blocker, along the segment
    double light_distance_m = 0;          ///< light distance of the blocker [m]
    double receiver_light_distance_m = 0; ///< light distance of P [m]
};

/// Exact answers about the light's rays, for one view, map resolution and culling (docs/causes.md).
///
/// Pixels are row-major indices; each must be scored. Depths of texels are those of the map that
/// they are of, depths of receivers those of the map that the pixel reads. All answers are the same
/// for any number of threads.
class LightQueries {
public:
    LightQueries() = default;
    LightQueries(const LightQueries&) = delete;
    LightQueries& operator=(const LightQueries&) = delete;
    virtual ~LightQueries() = default;

    /// The first hit of each texel-centre ray, with a triangle that the culling leaves, at a matrix
    /// depth in [0, 1]. A seam is a hit; other degenerate contacts are none.
    /// @param texels  in any order; fastest where sixteen in a row are neighbours, as 4×4.
    /// @return  In the order of the texels.
    [[nodiscard]] virtual std::vector<TexelHit> first_hits(std::span<const scene::Texel> texels,
                                                           HitDetail detail) const = 0;

    /// The same, placed. What is known makes it faster where the frusta differ in their near planes
    /// alone and this one's is not nearer.
    [[nodiscard]] virtual std::vector<TexelHit> first_hits(std::span<const scene::Texel> texels,
                                                           const KnownHits& known) const = 0;

    /// The exact matrix depth of P of each pixel, rounded once to float32: to nearest, ties to
    /// even; a result that would be subnormal is 0, which is positive.
    /// @return  In the order of the pixels, within half an ulp; any number, infinite ones included,
    ///          as P need not be between near and far; NaN for P in the light's camera plane.
    /// @param moved  `LookupTerms::moved`: of P′ in place of P, brought nearer to the light;
    /// nullptr:
    ///               of P itself.
    [[nodiscard]] virtual std::vector<float>
    receiver_depths(std::span<const std::size_t> pixels, const scene::MapIndices& maps,
                    const scene::Image<scene::Vec4f>* moved) const = 0;

    /// Where P exactly is on the map that the pixel reads: uv · resolution, rounded down to
    /// float32, so that it lies between the same texel centres, and borders, as the exact place.
    /// @param moved  as above.
    /// @return  In the order of the pixels; NaN in the light's camera plane.
    [[nodiscard]] virtual std::vector<scene::Vec2f>
    map_places(std::span<const std::size_t> pixels, const scene::MapIndices& maps,
               const scene::Image<scene::Vec4f>* moved) const = 0;
    /// How far GL's places are from those, if they are as exact as float32 transforms are with a
    /// large margin [texels]: 256 roundings of the largest terms of any point of the scene.
    [[nodiscard]] virtual double place_error_texels() const = 0;

    /// The depth of the first hit of the ray through a place of each texel (`first_hits`), rounded
    /// alike; without a hit the farthest, 1 (reversed: 0).
    /// @param texels  in any order; fastest where sixteen in a row are neighbours, as 4×4.
    /// @param place   of each, from its lower left [texels]; `texel_centre`, or in [0, 1).
    /// @return  In the order of the texels; [0, 1], within half an ulp.
    [[nodiscard]] virtual std::vector<float> texel_depths(std::span<const scene::Texel> texels,
                                                          const scene::Vec2d& place) const = 0;

    /// The depth of the second hit of each texel-centre ray: the first of those that are exactly
    /// farther along it than the first hit; rounded and, without one, as of `texel_depths`.
    [[nodiscard]] virtual std::vector<float>
    second_depths(std::span<const scene::Texel> texels) const = 0;

    /// For each query the smallest B, 0 or a normal float32, that makes exact depths lit: with r
    /// the exact matrix depth of P and d the tap's, r − B <= d (reversed: r + B >= d).
    /// @return  In the order of the queries; either sign; +∞ for P in the light's camera plane.
    [[nodiscard]] virtual std::vector<float> critical_biases(std::span<const NearestQuery> queries,
                                                             const ReceiverRule& rule) const = 0;
    [[nodiscard]] virtual std::vector<float> critical_biases(std::span<const LinearQuery> queries,
                                                             const ReceiverRule& rule) const = 0;

    /// For each pixel 1 where a triangle that the culling leaves crosses the open segment P→light,
    /// properly or through a seam, at a matrix depth in [0, 1]; else 0.
    [[nodiscard]] virtual std::vector<std::uint8_t>
    occluded(std::span<const std::size_t> pixels, const scene::MapIndices& maps) const = 0;

    /// The same at any depth, with the triangles that this culling leaves.
    [[nodiscard]] virtual std::vector<std::uint8_t>
    occluded_anywhere(std::span<const std::size_t> pixels, scene::Cull cull) const = 0;

    /// For each query 1 where the surface leads from P, along the straight line to the texel's
    /// centre in light view, into the triangle seen there (docs/truth.md); else 0.
    [[nodiscard]] virtual std::vector<std::uint8_t>
    are_self_shadowing(std::span<const SelfShadowingQuery> queries) const = 0;

    /// The blockers of blocked pixels among the triangles that this culling leaves, in their order;
    /// `no_triangle` where none of them blocks.
    [[nodiscard]] virtual std::vector<BlockerHit> find_blockers(std::span<const std::size_t> pixels,
                                                                scene::Cull cull) const = 0;
};

} // namespace gnomon::renderers
