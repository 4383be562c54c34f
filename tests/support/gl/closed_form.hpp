#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/job/file.hpp"
#include "scene/settings/job.hpp"

#include <cmath>
#include <string>

namespace gnomon::tests {

/// A plane whose acne has a closed form: its depth differs by up to half a texel's slope from the
/// depth at the texel's centre.
struct TiltedPlaneSetting {
    int angle_deg;
    int resolution;
    const char* format;
    double roll_deg;
};

[[nodiscard]] std::string text(const TiltedPlaneSetting& setting);
[[nodiscard]] scene::Job tilted_plane_job(const TiltedPlaneSetting& setting, double bias);

/// The exact depth, in [0, 1], of the scene's first triangle at texel coordinates. It is linear in
/// both under a directional light.
class PlaneDepth {
public:
    explicit PlaneDepth(const analysis::Comparison& result);

    [[nodiscard]] double operator()(double u_texels, double v_texels) const
    {
        return origin_.z + per_u_ * (u_texels - origin_.x) + per_v_ * (v_texels - origin_.y);
    }
    /// |∂d/∂u| + |∂d/∂v|
    [[nodiscard]] double per_texel() const { return std::abs(per_u_) + std::abs(per_v_); }

private:
    scene::Vec3d origin_;
    double per_u_ = 0;
    double per_v_ = 0;
};

/// The most that a plane's depth differs from that at the texel's centre: ½(|∂d/∂u| + |∂d/∂v|).
[[nodiscard]] double half_texel_slope(const TiltedPlaneSetting& setting,
                                      const scene::LightFrustum& frustum);

/// The smallest acne-free bias: `half_texel_slope`, plus half a code of the format or half an ulp
/// of a float32 below 1, plus the roundings of r and d, a few times 2^-24.
[[nodiscard]] double closed_form_bias(const TiltedPlaneSetting& setting,
                                      const scene::LightFrustum& frustum);

} // namespace gnomon::tests
