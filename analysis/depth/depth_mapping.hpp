#pragma once

#include "analysis/depth/split_depth.hpp"
#include "scene/light/frustum.hpp"

namespace gnomon::analysis {

/// The exact map between the distance ζ from the camera's plane and window depth in [0, 1].
///
///     perspective    d = f(ζ − n)/(ζ(f − n)),  1/ζ = 1/n − A·d,  A = 1/n − 1/f = (f − n)/(fn)
///     reversed       d = n(f − ζ)/(ζ(f − n)),  1/ζ = 1/f + A·d
///     orthographic   d = (ζ − n)/(f − n), reversed (f − ζ)/(f − n)
///     distances      d = ρ/f, ρ from the light in place of ζ: orthographic with n = 0
///
/// Source: docs/depth_precision.md#depth-of-a-distance.
class DepthMapping {
public:
    /// @throws std::domain_error  unless near < far, both finite, and 0 < near for a perspective.
    explicit DepthMapping(const scene::DepthRange& range);
    /// Of distances to the light, over far.
    /// @param near_m  The least that there is; what is stored counts from 0.
    /// @throws std::domain_error  unless 0 <= near < far, both finite.
    [[nodiscard]] static DepthMapping of_distances(double near_m, double far_m);

    [[nodiscard]] const scene::DepthRange& range() const { return range_; }
    [[nodiscard]] scene::MapContent content() const { return content_; }
    /// The least distance that there is [m].
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
    /// The same with 1 − d, both to a few 2^-53 of themselves and exact at near and far.
    [[nodiscard]] SplitDepth split_depth(double light_distance_m) const;
    /// The distance that a window depth stands for [m]; near and far are exact. With t the depth,
    /// or reversed 1 − d, sums of positive terms, to a few 2^-53 of the distance:
    ///
    ///     perspective    n/((1 − t) + (n/f)t) = f/(t + (f/n)(1 − t))
    ///     orthographic   n + t(f − n) = f − (1 − t)(f − n)
    [[nodiscard]] double light_distance_m(const SplitDepth& depth) const;
    [[nodiscard]] double light_distance_m(double depth) const
    {
        return light_distance_m({depth, 1 - depth});
    }
    /// How far the distance ζ' of a depth lies behind ζ [m]: AΔζζ', Δ(f − n) for an orthographic
    /// projection, to a few 2^-53 of the larger of the two distances.
    [[nodiscard]] double stored_error_m(double light_distance_m, const SplitDepth& stored) const;
    /// |dζ/dd| at ζ [m]: Aζ² for a perspective, far − near for an orthographic projection.
    [[nodiscard]] double slope_m(double light_distance_m) const;
    /// How far a signed depth error moves the distance [m]: AΔζ²/(1 − AΔζ), exactly; Δ(f − n) for
    /// an orthographic projection; infinite where the depth stands for no distance any more.
    [[nodiscard]] double light_distance_error_m(double light_distance_m, double depth_error) const;
    /// The same, for the sign of the depth error with which |ζ' − ζ| is larger.
    [[nodiscard]] double largest_light_distance_error_m(double light_distance_m,
                                                        double depth_error) const;

private:
    /// From depth 0 to depth 1 [m].
    [[nodiscard]] double extent_m() const { return range_.far_m - range_.near_m; }

    scene::DepthRange range_;
    scene::MapContent content_ = scene::MapContent::depth;
    double near_m_;
    double depth_per_inverse_m_; ///< A [1/m]
};

} // namespace gnomon::analysis
