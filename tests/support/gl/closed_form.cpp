#include "closed_form.hpp"

#include "methods_job.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gnomon::tests {

std::string text(const TiltedPlaneSetting& setting)
{
    return fmt::format("{} deg, {}², {}, roll {}", setting.angle_deg, setting.resolution,
                       setting.format, setting.roll_deg);
}

scene::Job tilted_plane_job(const TiltedPlaneSetting& setting, double bias)
{
    return tests::builtin_job(
               "tilted-plane",
               {{"scene.tilted-plane.angle_deg", fmt::format("{}", setting.angle_deg)},
                {"shadow_map.resolution", fmt::format("{}", setting.resolution)},
                {"shadow_map.depth_format", setting.format},
                {"shadow_map.roll_deg", fmt::format("{}", setting.roll_deg)},
                {"bias.constant", fmt::format("{}", bias)}})
        .job;
}

PlaneDepth::PlaneDepth(const analysis::Comparison& result)
{
    const auto& matrix = result.view.first_map().light_clip_from_world_exact;
    const double texels = result.job.shadow_map.resolution_texels;
    std::array<scene::Vec3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto clip = matrix * scene::Vec4d{scene::Vec3d{result.triangles->corners(0)[i]}, 1.0};
        corners[i] = {0.5 * (clip.x + 1) * texels, 0.5 * (clip.y + 1) * texels, 0.5 * (clip.z + 1)};
    }
    origin_ = corners[0];
    const auto normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    per_u_ = -normal.x / normal.z;
    per_v_ = -normal.y / normal.z;
}

double half_texel_slope(const TiltedPlaneSetting& setting, const scene::LightFrustum& frustum)
{
    const double slope = std::tan(setting.angle_deg * std::numbers::pi / 180);
    const double roll_rad = setting.roll_deg * std::numbers::pi / 180;
    const double texel_m = frustum.texel_width_m(1, setting.resolution);
    const double per_texel = slope * texel_m / frustum.range_m();
    return 0.5 * per_texel * (std::abs(std::cos(roll_rad)) + std::abs(std::sin(roll_rad)));
}

double closed_form_bias(const TiltedPlaneSetting& setting, const scene::LightFrustum& frustum)
{
    const auto format = scene::depth_format_from_name(setting.format).value();
    const double rounding = format.is_float() ? 0x1p-25 : 0.5 / (std::ldexp(1.0, format.bits) - 1);
    return half_texel_slope(setting, frustum) + rounding + 4 * 0x1p-24;
}

} // namespace gnomon::tests
