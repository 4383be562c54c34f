// A cube's seams add no errors: the pixels beside them have as many errors as when the room, its
// lamp and the camera are turned by 45°. The faces keep their axes, so the seams then lie
// elsewhere.

#include "compared.hpp"
#include "gl_case.hpp"
#include "lane.hpp"
#include "methods_job.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

namespace gnomon::tests {
namespace {

constexpr int resolution = 2048;

/// A camera in the room before it is turned [m].
struct Sight {
    scene::Vec3d eye;
    scene::Vec3d target;
};
constexpr std::array<Sight, 4> sights{{{{-2.1, 1.7, 2.2}, {0.9, 0.9, -0.9}},
                                       {{2.2, 2.3, 2.2}, {-0.6, 0.6, -0.7}},
                                       {{2.3, 0.6, -2.2}, {-0.7, 1.2, 0.9}},
                                       {{-1, 2.3, -2.3}, {0.6, 0.3, 1.2}}}};

/// Turns a point about the vertical axis, from z towards x.
std::string turned(const scene::Vec3d& point, double turn_deg)
{
    const double c = std::cos(glm::radians(turn_deg));
    const double s = std::sin(glm::radians(turn_deg));
    return fmt::format("[{}, {}, {}]", c * point.x + s * point.z, point.y,
                       c * point.z - s * point.x);
}

analysis::Comparison compare_turned(double turn_deg, const Sight& sight,
                                    const std::vector<scene::Override>& more)
{
    std::vector<scene::Override> keys{{"scene.lamp-room.turn_deg", fmt::format("{}", turn_deg)},
                                      {"camera.eye", turned(sight.eye, turn_deg)},
                                      {"camera.target", turned(sight.target, turn_deg)},
                                      {"shadow_map.resolution", std::to_string(resolution)},
                                      {"image.width", "960"},
                                      {"image.height", "540"}};
    keys.insert(keys.end(), more.begin(), more.end());
    const scene::Job job = tests::builtin_job("lamp-room", keys).job;
    return Compared{job}.without_diagnosis(job);
}

/// The distance of a pixel's lookup from the nearest seam [texels].
float from_seam(const analysis::Comparison& room, std::size_t pixel)
{
    const scene::Vec2f at = room.lookup.texels[pixel];
    return std::min({at.x, at.y, resolution - at.x, resolution - at.y});
}

bool is_wrong(const analysis::Comparison& room, std::size_t pixel)
{
    return scene::is_lit(room.lookup.samples[pixel].verdict) !=
           (room.truth.pixel_class[pixel] == scene::PixelClass::lit);
}

struct Errors {
    std::uint64_t near_seam = 0;
    std::uint64_t far_from_it = 0;
    std::uint64_t pixels = 0;
};

/// Adds the pixels that are near a seam in one room and far from all in the other.
void count(const analysis::Comparison& room, const analysis::Comparison& turned, Errors& errors)
{
    constexpr float near_texels = 96;
    constexpr float far_texels = 192;
    for (std::size_t i = 0; i < room.truth.pixel_class.pixel_count(); ++i) {
        if (scene::is_scored(room.truth.pixel_class[i]) &&
            room.truth.pixel_class[i] == turned.truth.pixel_class[i] &&
            from_seam(room, i) < near_texels && from_seam(turned, i) > far_texels) {
            ++errors.pixels;
            errors.near_seam += is_wrong(room, i) ? 1U : 0U;
            errors.far_from_it += is_wrong(turned, i) ? 1U : 0U;
        }
    }
}

class Seams : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

/// The bias leaves no acne, which would depend on how surfaces lie to a face's axes. Only borders
/// of shadows are left, as wide as a texel. Beside a seam, 45° off its face's axis, a texel is cos²
/// 45° = ½ as wide across the seam as in the middle, and cos 45° along it. So there are at most as
/// many errors as far from seams, and at least half.
TEST_P(Seams, AddNoErrors)
{
    GNOMON_REQUIRE_GL();
    const auto& [filter, content] = GetParam();
    const std::vector<scene::Override> keys{{"lookup.filter", filter},
                                            {"shadow_map.content", content},
                                            {"shadow_map.depth_format", "d32f"},
                                            {"bias.constant", "0.01"}};
    Errors errors;
    // The usual lane tries every other sight.
    for (std::size_t i = 0; i < sights.size(); i += in_lane(2U, 1U)) {
        const Sight& sight = sights[i];
        const auto room = compare_turned(0, sight, keys);
        const auto turned_room = compare_turned(45, sight, keys);
        count(room, turned_room, errors);
        count(turned_room, room, errors);
    }
    std::printf("%s, %s: of %llu pixels %llu wrong near a seam, %llu far from it\n", filter,
                content, static_cast<unsigned long long>(errors.pixels),
                static_cast<unsigned long long>(errors.near_seam),
                static_cast<unsigned long long>(errors.far_from_it));
    const auto near_seam = static_cast<double>(errors.near_seam);
    const auto far_from_it = static_cast<double>(errors.far_from_it);
    EXPECT_GT(errors.pixels, in_lane(50'000U, 100'000U));
    EXPECT_GT(far_from_it, in_lane(10, 20));
    const double by_chance = 3 * std::sqrt(std::max(near_seam, far_from_it));
    EXPECT_LE(near_seam, far_from_it + by_chance);
    EXPECT_GE(near_seam, far_from_it / 2 - by_chance);
}

INSTANTIATE_TEST_SUITE_P(OfCubes, Seams,
                         testing::Combine(testing::Values("nearest", "pcf3", "hardware"),
                                          testing::Values("depth", "distance")));

} // namespace
} // namespace gnomon::tests
