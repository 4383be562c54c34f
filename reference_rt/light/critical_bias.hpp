#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/map_place.hpp"
#include "reference_rt/light/maps_of_light.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"
#include "scene/geometry/triangles.hpp"

#include <array>
#include <cstddef>

namespace gnomon::reference_rt {

/// The depth of a point, or the distance that a map stores instead: an interval, and the data to
/// compute it exactly.
class DepthTerm {
public:
    /// A constant.
    explicit DepthTerm(double constant = 0) : interval_{constant, 0}, constant_{constant} {}
    /// The depth of a ray's hit with a plane, or of a point at `offset` from it, with its interval.
    /// Hit and depth must outlive the term.
    DepthTerm(const LightDepth& depth, const Receiver& hit, const Interval& bounded,
              const scene::Vec3d& offset = scene::Vec3d{0.0})
        : interval_{bounded},
          depth_{&depth},
          hit_{&hit},
          offset_{offset}
    {
    }

    DepthTerm(const LightDistance& distance, const Receiver& hit, const Interval& bounded,
              const scene::Vec3d& offset = scene::Vec3d{0.0})
        : interval_{bounded},
          distance_{&distance},
          hit_{&hit},
          offset_{offset}
    {
    }

    [[nodiscard]] Interval bounded() const { return interval_; }
    /// A far tighter bound, at a cost; its error is infinite if the hit is not well scaled.
    [[nodiscard]] DoubleDouble sharp() const;
    [[nodiscard]] ExactDepth exact() const;
    /// Clamped to [0, 1].
    [[nodiscard]] DepthTerm clamped() const;
    /// Adds a finite number.
    [[nodiscard]] DepthTerm shifted(double by) const;
    /// Rounded once to float32 by `ToNearest`; NaN in the light's camera plane.
    [[nodiscard]] float nearest_float() const;

private:
    /// The exact sign of this − number.
    [[nodiscard]] Sign sign_beyond(double number) const;

    Interval interval_;   ///< of the whole value
    double constant_ = 0; ///< used without a hit
    const LightDepth* depth_ = nullptr;
    const LightDistance* distance_ = nullptr;
    const Receiver* hit_ = nullptr;
    scene::Vec3d offset_{0.0};
    double shift_ = 0; ///< added to the hit's depth or to the constant
};

/// The hit of a texel's ray. Must not move, as the hit refers to the ray and triangle.
struct TapHit {
    CameraRay ray;
    ExactTriangle face;
    Receiver hit;
};

/// Computes the depths of taps: of triangles along texel rays in the texel's map, or constants.
class TapDepths {
public:
    /// All arguments must outlive this object.
    TapDepths(const scene::TriangleScene& triangles, const MapsOfLight& maps)
        : triangles_{triangles},
          maps_{maps}
    {
    }

    /// As `first_hits` found it.
    [[nodiscard]] static Interval known(const renderers::ExactTap& tap)
    {
        const Interval depth = known_hit(tap);
        return tap.shift == 0 ? depth : depth + Interval{tap.shift, 0};
    }
    /// @param hit  filled with the hit; it must outlive the term.
    [[nodiscard]] DepthTerm term(const renderers::ExactTap& tap, TapHit& hit) const;
    /// Rounded once to float32 by `ToNearest`.
    [[nodiscard]] float nearest_float(const renderers::ExactTap& tap) const;

    [[nodiscard]] bool is_reversed() const { return maps_.depths.front().is_reversed(); }

private:
    /// The depth before `shift` is added.
    [[nodiscard]] static Interval known_hit(const renderers::ExactTap& tap)
    {
        return {tap.depth, tap.triangle == scene::no_triangle ? 0 : tap.depth_error};
    }

    const scene::TriangleScene& triangles_;
    const MapsOfLight& maps_;
};

/// The smallest bias >= `x`: 0 or a normal float32 of either sign, as GL's biases; +∞ if `x`
/// exceeds all of them.
[[nodiscard]] float smallest_bias_from(double x);

/// Finds the smallest bias for which an exact receiver depth is lit against an exact map depth.
class CriticalBias {
public:
    explicit CriticalBias(const TapDepths& taps) : taps_{taps} {}

    /// The smallest B with r − B <= d (reversed: r + B >= d), d the tap's depth; infinite if the
    /// receiver lies in the light's camera plane.
    [[nodiscard]] float find(const DepthTerm& receiver, const renderers::ExactTap& tap) const;
    /// As above, with d = Σ weight·depth of the taps.
    [[nodiscard]] float find(const DepthTerm& receiver,
                             const std::array<renderers::ExactTap, 4>& taps,
                             const BilinearWeights& weights) const;

private:
    /// @param weights  returns the weights in the precision of its argument.
    template <std::size_t n, typename Weights>
    [[nodiscard]] float find(const DepthTerm& receiver,
                             const std::array<renderers::ExactTap, n>& taps,
                             const Weights& weights) const;

    TapDepths taps_;
};

} // namespace gnomon::reference_rt
