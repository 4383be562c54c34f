#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/maps_of_light.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"
#include "scene/geometry/triangles.hpp"

namespace gnomon::reference_rt {

/// The depth of a point, or what a map stores in its place: bounded, and what makes it exact.
class DepthTerm {
public:
    /// A constant.
    explicit DepthTerm(double constant = 0) : interval_{constant, 0}, constant_{constant} {}
    /// Of the hit of a ray with a plane, or a point moved by `offset` from it, already bounded; hit
    /// and depth must outlive the term.
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
    /// Bounded far more closely, at a cost; with an infinite error where the hit is not well
    /// scaled.
    [[nodiscard]] Wide sharp() const;
    [[nodiscard]] ExactDepth exact() const;
    /// The same, limited to [0, 1].
    [[nodiscard]] DepthTerm clamped() const;
    /// The sum with a finite number.
    [[nodiscard]] DepthTerm shifted(double by) const;
    /// Rounded once to float32 by `ToNearest`; NaN in the light's camera plane.
    [[nodiscard]] float nearest_float() const;

private:
    /// Sign of it less a number, exactly.
    [[nodiscard]] Sign sign_beyond(double number) const;

    Interval interval_;   ///< of all of it
    double constant_ = 0; ///< without a hit
    const LightDepth* depth_ = nullptr;
    const LightDistance* distance_ = nullptr;
    const Receiver* hit_ = nullptr;
    scene::Vec3d offset_{0.0};
    double shift_ = 0; ///< added to what hit or constant says
};

/// What a texel's ray meets; it stays where it is, as the hit refers to its ray and triangle.
struct TapHit {
    CameraRay ray;
    ExactTriangle face;
    Receiver hit;
};

/// Finds the depths of taps: those of triangles along the rays of texels, in the maps that these
/// are of, or constants.
class TapDepths {
public:
    /// All arguments must outlive it.
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
    /// @param hit  to be found again; it must outlive the term.
    [[nodiscard]] DepthTerm term(const renderers::ExactTap& tap, TapHit& hit) const;
    /// Rounded once to float32 by `ToNearest`.
    [[nodiscard]] float nearest_float(const renderers::ExactTap& tap) const;

    [[nodiscard]] bool is_reversed() const { return maps_.depths.front().is_reversed(); }

private:
    /// Before it is shifted.
    [[nodiscard]] static Interval known_hit(const renderers::ExactTap& tap)
    {
        return {tap.depth, tap.triangle == scene::no_triangle ? 0 : tap.depth_error};
    }

    const scene::TriangleScene& triangles_;
    const MapsOfLight& maps_;
};

} // namespace gnomon::reference_rt
