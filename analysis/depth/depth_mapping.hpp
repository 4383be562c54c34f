#pragma once

#include "scene/light/frustum.hpp"

namespace gnomon::analysis {

/// A window depth d in [0, 1] together with 1 − d. Near 1, where a perspective crowds depths, d
/// alone would lose the digits that decide the distance.
struct SplitDepth {
    double depth = 0;
    double complement = 1;
};

/// a − b, from whichever halves are small at b: off by a few 2^-53 of these, not of 1.
[[nodiscard]] inline double difference(const SplitDepth& a, const SplitDepth& b)
{
    return b.depth < b.complement ? a.depth - b.depth : b.complement - a.complement;
}

/// The exact map between the distance ζ from the camera's plane and window depth in [0, 1].
///
///     perspective    d = f(ζ − n)/(ζ(f − n)),  1/ζ = 1/n − A·d,  A = 1/n − 1/f = (f − n)/(fn)
///     reversed       d = n(f − ζ)/(ζ(f − n)),  1/ζ = 1/f + A·d
///     orthographic   d = (ζ − n)/(f − n), reversed (f − ζ)/(f − n)
///     distances      d = ρ/f, ρ from the light in place of ζ: orthographic with n = 0
///
/// A bias b moves a receiver towards the light, equally far with reversed depth.
/// Source: docs/depth_precision.md#depth-of-a-distance; docs/bias_curve.md#units.
class DepthMapping {
public:
    /// @throws std::domain_error  unless near < far, both finite, and 0 < near for a perspective.
    explicit DepthMapping(const scene::DepthRange& range);
    /// The mapping of a map's content, for points from near to far; some contents count from 0.
    /// @param drawn  The range of GL's depth over ζ.
    /// @throws std::domain_error  As above, and unless 0 <= near for contents other than GL's
    ///                            depth.
    DepthMapping(scene::MapContent content, const scene::DepthRange& drawn);

    [[nodiscard]] const scene::DepthRange& range() const { return range_; }
    [[nodiscard]] scene::MapContent content() const { return content_; }
    [[nodiscard]] bool stores_gl_depth() const { return traits_of(content_).is_gl_depth(); }
    [[nodiscard]] scene::Measure measure() const { return traits_of(content_).measure; }
    /// The smallest distance [m].
    [[nodiscard]] double near_m() const { return near_m_; }
    [[nodiscard]] double far_m() const { return range_.far_m; }
    [[nodiscard]] bool is_perspective() const
    {
        return range_.projection == scene::Projection::perspective;
    }

    /// Window depth of a distance; in [0, 1] for ζ in [near, far].
    [[nodiscard]] double depth(double light_distance_m) const
    {
        return split_depth(light_distance_m).depth;
    }
    /// d and 1 − d, each to a few 2^-53 of itself and exact at near and far.
    [[nodiscard]] SplitDepth split_depth(double light_distance_m) const;
    /// The distance that a window depth stands for [m], to a few 2^-53 of it; near and far are
    /// exact. Sums of positive terms, with t the depth, or 1 − d if reversed:
    ///
    ///     perspective    n/((1 − t) + (n/f)t) = f/(t + (f/n)(1 − t))
    ///     orthographic   n + t(f − n) = f − (1 − t)(f − n)
    [[nodiscard]] double light_distance_m(const SplitDepth& depth) const;
    [[nodiscard]] double light_distance_m(double depth) const
    {
        return light_distance_m({depth, 1 - depth});
    }
    /// How far the distance ζ' of a stored depth lies behind ζ [m]: AΔζζ', or Δ(f − n) for an
    /// orthographic projection; to a few 2^-53 of the larger distance.
    [[nodiscard]] double stored_error_m(double light_distance_m, const SplitDepth& stored) const;
    /// |dζ/dd| at ζ [m]: Aζ² for a perspective, f − n for an orthographic projection.
    [[nodiscard]] double slope_m(double light_distance_m) const;
    /// How far a signed depth error moves the distance [m]: exactly AΔζ²/(1 − AΔζ), or Δ(f − n) for
    /// an orthographic projection; infinite if no distance has the resulting depth.
    [[nodiscard]] double light_distance_error_m(double light_distance_m, double depth_error) const;
    /// `light_distance_error_m` for the sign of the depth error with the larger |ζ' − ζ|.
    [[nodiscard]] double largest_light_distance_error_m(double light_distance_m,
                                                        double depth_error) const;
    /// How far a constant bias moves a receiver at ζ [m]: b(f − n), or Abζ²/(1 + Abζ) for a
    /// perspective, −∞ beyond every distance. Infinite for an infinite bias.
    [[nodiscard]] double bias_length_m(double bias, double light_distance_m) const;
    /// The bias that moves a receiver by a length of at least 0; infinite if a perspective's
    /// receiver would reach the light.
    [[nodiscard]] double bias_of_length(double length_m, double light_distance_m) const;
    /// |dd/dζ| at ζ [1/m], with the A of biases.
    [[nodiscard]] double depth_per_metre(double light_distance_m) const;

private:
    /// From depth 0 to depth 1 [m].
    [[nodiscard]] double extent_m() const { return range_.range_m(); }
    /// A as biases use it [1/m]; its last bits differ from those of `depth_per_inverse_m_`.
    [[nodiscard]] double bias_per_inverse_m() const
    {
        return 1.0 / range_.near_m - 1.0 / range_.far_m;
    }

    scene::DepthRange range_;
    scene::MapContent content_ = scene::MapContent::depth;
    double near_m_;
    double depth_per_inverse_m_; ///< A [1/m]
};

} // namespace gnomon::analysis
