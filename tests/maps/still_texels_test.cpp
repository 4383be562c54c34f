// While the camera walks, stabilised cascades keep the verdicts of world points, except next to
// texel borders.

#include "methods_job.hpp"
#include "reference_rt/light/light_queries.hpp"
#include "reference_rt/truth.hpp"
#include "scene/job/file.hpp"
#include "scene/light/map_choice.hpp"
#include "scene/load/load_scene.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

constexpr int texels_across = 128;

/// A point's place in a cascade by float32 lookup, and its verdict by exact rays.
struct WorldVerdict {
    bool is_lit = false;
    double to_border_texels = 0;
    double largest_off_texels = 0; ///< (4·(S + |t|) + 1)·2^-24·N/2, of the worse axis
};

/// Stabilised cascades without a bias, for a camera that moves.
class StillCascades {
public:
    StillCascades()
        : job_{tests::builtin_job("columns").job},
          file_{scene::load_scene(job_.scene)},
          reference_{file_.scene}
    {
        job_.image = {16, 9};
        job_.light.emplace();
        job_.light->direction = scene::Vec3d{0.5, -1, -0.35};
        job_.shadow_map.frustum.roll_deg =
            30; // otherwise a row of texels on the ground has one depth
        job_.shadow_map.resolution_texels = texels_across;
        job_.shadow_map.layout = scene::MapLayout::cascades;
        scene::CascadeSettings& cascades = job_.shadow_map.cascades;
        cascades.fit = scene::CascadeFit::stabilised;
        cascades.near_m = 0.5;
        cascades.far_m = 40;
    }

    void look(const scene::Vec3d& eye, const scene::Vec3d& target)
    {
        job_.camera.emplace();
        job_.camera->eye = eye;
        job_.camera->target = target;
        view_ = scene::resolve_view(job_, file_.scene, file_.defaults);
        receivers_ = scene::Image<std::uint32_t>{view_.image, scene::no_triangle};
        light_ = reference_rt::make_light_queries(reference_, view_, receivers_, texels_across,
                                                  scene::Cull::none, 1);
    }

    [[nodiscard]] std::size_t map_count() const { return view_.maps.size(); }

    /// Empty for points that the cascade does not contain.
    [[nodiscard]] std::vector<std::optional<WorldVerdict>>
    verdicts(std::size_t map, const std::vector<scene::Vec3f>& points) const
    {
        const scene::Mat4f& matrix = view_.maps[map].light_clip_from_world;
        std::vector<std::optional<WorldVerdict>> all(points.size());
        std::vector<scene::Texel> texels;
        std::vector<std::size_t> inside;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const scene::Vec4f clip = scene::clip_position(matrix, points[i]);
            if (scene::contains(view_.maps[map], clip)) {
                all[i] = placed(matrix, clip, points[i]);
                texels.push_back({floor_of(clip.x), floor_of(clip.y), static_cast<int>(map)});
                inside.push_back(i);
            }
        }
        const auto hits = light_->first_hits(texels, renderers::HitDetail::placed);
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const double r = depth_of(matrix, points[inside[i]]);
            all[inside[i]]->is_lit = r <= hits[i].depth;
        }
        return all;
    }

    /// The nearest point of this height on a border between columns of texels, up to rounding.
    [[nodiscard]] scene::Vec3f on_border(std::size_t map, const scene::Vec3f& point) const
    {
        const scene::LightFrustum& frustum = view_.maps[map];
        const scene::Vec4f clip = scene::clip_position(frustum.light_clip_from_world, point);
        const double texel{texel_of(clip.x)};
        const double off_m = (std::round(texel) - texel) * frustum.texel_width_m(1, texels_across);
        const scene::Vec3d level{frustum.right.x, 0, frustum.right.z};
        return scene::Vec3f{scene::Vec3d{point} + off_m / glm::dot(level, level) * level};
    }

private:
    static float texel_of(float clip) { return (clip * 0.5F + 0.5F) * texels_across; }
    static int floor_of(float clip) { return static_cast<int>(std::floor(texel_of(clip))); }

    static WorldVerdict placed(const scene::Mat4f& matrix, const scene::Vec4f& clip,
                               const scene::Vec3f& point)
    {
        WorldVerdict verdict{false, 1, 0};
        for (int row = 0; row < 2; ++row) {
            const double texel{texel_of(clip[row])};
            double sum = std::abs(double{matrix[3][row]});
            for (int column = 0; column < 3; ++column) {
                sum += std::abs(double{matrix[column][row]} * double{point[column]});
            }
            verdict.to_border_texels =
                std::min(verdict.to_border_texels, std::abs(texel - std::round(texel)));
            verdict.largest_off_texels = std::max(verdict.largest_off_texels,
                                                  (4 * sum + 1) * 0x1p-24 * (texels_across / 2.0));
        }
        return verdict;
    }
    /// In double, whose roundings are far below the error of a hit's place.
    static double depth_of(const scene::Mat4f& matrix, const scene::Vec3f& point)
    {
        double z{matrix[3][2]};
        for (int column = 0; column < 3; ++column) {
            z += double{matrix[column][2]} * double{point[column]};
        }
        return 0.5 * z + 0.5;
    }

    scene::Job job_;
    scene::SceneFile file_;
    reference_rt::ReferenceScene reference_;
    scene::View view_;
    scene::Image<std::uint32_t> receivers_;
    std::unique_ptr<renderers::LightQueries> light_;
};

/// Points on the ground, each on a border between columns of texels of a cascade, up to rounding.
std::vector<scene::Vec3f> border_points(const StillCascades& cascades, std::size_t count)
{
    std::mt19937 random{31};
    std::uniform_real_distribution<float> metres{-6, 6};
    std::vector<scene::Vec3f> points;
    for (std::size_t i = 0; i < count; ++i) {
        const scene::Vec3f anywhere{metres(random), 0.0F, metres(random)};
        points.push_back(cascades.on_border(i % cascades.map_count(), anywhere));
    }
    return points;
}

TEST(StabilisedCascades, ChangeVerdictsOfWorldPointsNextToBordersOfTexelsAlone)
{
    StillCascades cascades;
    std::mt19937 random{32};
    std::uniform_real_distribution<double> metres{-1, 1};
    scene::Vec3d eye{0, 3, 12};
    cascades.look(eye, {0, 1, 0});
    const std::vector<scene::Vec3f> points = border_points(cascades, 256);
    std::vector<std::vector<std::optional<WorldVerdict>>> last(cascades.map_count());
    std::size_t compared = 0;
    std::size_t lit = 0;
    std::size_t changed = 0;
    for (int step = 0; step < 1000; ++step) {
        eye += 0.2 * scene::Vec3d{metres(random), 0.2 * metres(random), metres(random)};
        cascades.look(eye, scene::Vec3d{metres(random), 1, metres(random)});
        for (std::size_t map = 0; map < cascades.map_count(); ++map) {
            auto now = cascades.verdicts(map, points);
            for (std::size_t i = 0; i < now.size() && !last[map].empty(); ++i) {
                const auto& before = last[map][i];
                if (!now[i] || !before) {
                    continue;
                }
                ++compared;
                lit += now[i]->is_lit ? 1U : 0U;
                if (now[i]->is_lit != before->is_lit) {
                    ++changed;
                    EXPECT_LE(std::min(now[i]->to_border_texels, before->to_border_texels),
                              now[i]->largest_off_texels)
                        << "step " << step << ", map " << map << ", point " << i;
                }
            }
            last[map] = std::move(now);
        }
    }
    EXPECT_GT(compared, 400'000U);
    EXPECT_GT(std::min(lit, compared - lit), compared / 50);
    EXPECT_GT(changed, 0U);
    EXPECT_LT(changed, compared / 100);
}

} // namespace
} // namespace gnomon::tests
