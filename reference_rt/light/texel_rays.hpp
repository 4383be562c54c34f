#pragma once

#include "renderers/light_queries.hpp"
#include "scene/camera/camera.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"
#include "scene/vec.hpp"

namespace gnomon::reference_rt {

/// The rows of the float32 `light_clip_from_world`, as exact doubles.
struct ClipRows {
    explicit ClipRows(const scene::LightFrustum& frustum);

    scene::Vec4d x, y, z, w;
};

/// The light's rays through the centres of a shadow map's texels.
///
/// With rows X, Y, Z, W of the float32 `light_clip_from_world`, evaluated in double in exactly this
/// order without contraction, the resulting bits define the ray:
///
///     u = (2x + 1 − n)/n,  v alike;   A = X − uW,   B = Y − vW        (2x + 2p for another place p
///                                                                      of the texel than its ½)
///     spot:         from the light's position
///     directional:  from −((A.w (B × N) + B.w (N × A)) + N.w (A × B))/(A·(B × N)), where A, B and
///                   the near plane N = Z + W (reversed: W − Z) meet
///     along ±A × B, scaled by a power of two until its largest component is in [1, 2); the sign
///     is that of increasing ζ
class TexelRays {
public:
    /// @param light  the frustum's light.
    /// @param place  position in each texel that its ray passes through.
    TexelRays(const scene::LightFrustum& frustum, const scene::Light& light, int resolution_texels,
              const scene::Vec2d& place = scene::texel_centre);

    [[nodiscard]] scene::Ray ray(scene::Texel texel) const;

    [[nodiscard]] int resolution_texels() const { return resolution_; }
    /// The light of these rays. A directional light has the rays' direction, which differs from the
    /// job's in the last bits of a float32.
    [[nodiscard]] const scene::Light& light() const { return light_; }
    /// Whether all rays start at one point.
    [[nodiscard]] bool has_positional() const { return light_.has_position(); }

private:
    [[nodiscard]] scene::Vec3d direction(const scene::Vec4d& a, const scene::Vec4d& b) const;

    /// Cross products such as A × B. They are constant for a directional light, whose W is 0 except
    /// in the last component.
    struct Crosses {
        Crosses(const scene::Vec3d& a, const scene::Vec3d& b, const scene::Vec3d& n);

        scene::Vec3d b_near, near_a, a_b;
        double a_b_near; ///< A·(B × N)
    };

    ClipRows rows_;
    scene::Vec4d near_; ///< N
    Crosses crosses_;
    scene::Vec3d forward_;
    int resolution_;
    scene::Vec2d twice_place_;
    scene::Light light_;
};

} // namespace gnomon::reference_rt
