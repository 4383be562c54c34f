#include "closed_form.hpp"
#include "compared.hpp"
#include "expectations.hpp"
#include "lane.hpp"
#include "methods_job.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <utility>

/// Scenes that are constructed for one cause or label.
namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Label;
using Keys = std::vector<scene::Override>;

scene::Job job_of(const std::string& builtin, const Keys& keys)
{
    return tests::builtin_job(builtin, keys).job;
}

analysis::Comparison compared(const std::string& builtin, const Keys& keys)
{
    const scene::Job job = job_of(builtin, keys);
    analysis::Comparison result = Compared{job}(job);
    result.triangles = nullptr; // the scene is gone
    return result;
}

const analysis::CauseCounts& counts_of(const analysis::Comparison& result)
{
    return result.diagnosis->causes.counts;
}

TEST(Room, LeaksOnlyWhereItsWallsAreThinnerThanTheBiasOrATexel)
{
    GNOMON_REQUIRE_GL();
    const auto room = [](double thickness_m, double bias_m, int resolution) {
        return compared("room", {{"scene.room.wall_thickness_m", fmt::format("{}", thickness_m)},
                                 {"bias.constant_m", fmt::format("{}", bias_m)},
                                 {"shadow_map.resolution", fmt::format("{}", resolution)}});
    };
    // Along the light, (0.55, −1, −0.35), a wall is up to 3.5 times as thick as it is. 0.05 m is
    // more than that for walls of 0.01 m.
    const auto biased = room(0.01, 0.05, 1024);
    EXPECT_GT(biased.metrics.false_lit, 1000U);
    EXPECT_EQ(counts_of(biased).of(Label::peter_panning), biased.metrics.false_lit);
    // Texels are 0.13 m wide, walls 0.01 m.
    const auto coarse = room(0.01, 0, 64);
    EXPECT_GT(coarse.metrics.false_lit, 1000U);
    EXPECT_EQ(counts_of(coarse).of(Label::edge) + counts_of(coarse).of(Label::leak),
              coarse.metrics.false_lit);
    // Walls are ten times as thick as the bias, and twenty times as thick as a texel is wide.
    EXPECT_EQ(room(0.2, 0.02, 1024).metrics.false_lit, 0U);
}

TEST(Fence, IsLostBelowTheTexelAndRaggedAboveIt)
{
    GNOMON_REQUIRE_GL();
    const auto fence = [](double width_m, int resolution) {
        return compared("fence", {{"scene.fence.slat_width_m", fmt::format("{}", width_m)},
                                  {"scene.fence.spacing_m", "0.5"},
                                  {"scene.fence.slat_count", "8"},
                                  {"scene.fence.slat_thickness_m", "0"},
                                  {"bias.constant_m", "0"},
                                  {"shadow_map.resolution", fmt::format("{}", resolution)}});
    };
    const auto thin = fence(0.002, 128);
    const double texel_m = thin.view.first_map().texel_width_m(1, 128);
    ASSERT_NEAR(0.002 / texel_m, 0.05, 0.015); // a twentieth of a texel
    EXPECT_GE(static_cast<double>(counts_of(thin).of(Label::leak)),
              0.8 * static_cast<double>(thin.metrics.false_lit));
    EXPECT_GT(thin.metrics.false_lit, 100U);
    const auto wide = fence(0.1, 256);
    ASSERT_GT(0.1 / wide.view.first_map().texel_width_m(1, 256), 4); // four texels and more
    EXPECT_GE(static_cast<double>(counts_of(wide).of(Label::edge)),
              0.99 * static_cast<double>(wide.metrics.false_lit));
    EXPECT_GT(wide.metrics.false_lit, 100U);
}

TEST(NearPlane, PastAnOccluderMakesLeaksByCoverage)
{
    GNOMON_REQUIRE_GL();
    // The sphere lies nearer than 8 m to the light, the plane farther.
    const auto result =
        compared("sphere-plane", {{"shadow_map.near", "8"}, {"bias.constant", "0"}});
    EXPECT_GT(result.metrics.false_lit, 10000U);
    EXPECT_EQ(counts_of(result).of(Cause::coverage), result.metrics.false_lit);
    EXPECT_EQ(counts_of(result).of(Label::leak), result.metrics.false_lit);
}

/// Expects at least this share of the false shadows to have a cause.
void expect_share(const analysis::Comparison& result, Cause cause, double share,
                  const std::string& label)
{
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < result.truth.pixel_class.pixel_count(); ++i) {
        const bool is_lit = result.truth.pixel_class[i] == scene::PixelClass::lit;
        count += is_lit && result.diagnosis->causes.cause[i] == cause ? 1U : 0U;
    }
    EXPECT_GT(result.metrics.false_shadow, 1000U) << label;
    EXPECT_GE(static_cast<double>(count), share * static_cast<double>(result.metrics.false_shadow))
        << label;
}

TEST(Precision, IsTheCauseWhereTheBiasCoversTheTexelsSlopeButNotTheStep)
{
    GNOMON_REQUIRE_GL();
    const TiltedPlaneSetting plane{45, 8192, "u8", 0};
    const scene::Job job = tilted_plane_job(plane, 0);
    const Compared scene{job};
    const auto frustum = resolve_view(job, scene.file().scene, scene.file().defaults).first_map();
    const double slope = closed_form_bias({45, 8192, "d32f", 0}, frustum);
    expect_share(scene(tilted_plane_job(plane, slope + 0.25 / 255)), Cause::precision, 0.95,
                 "tilted-plane");
    // The terrain's steepest slopes meet the low sun at 80 degrees and more, so a slope bias covers
    // the slopes of its texels.
    const auto terrain = compared("terrain", {{"shadow_map.resolution", "8192"},
                                              {"shadow_map.depth_format", "u8"},
                                              {"bias.slope", "0.0002"},
                                              {"bias.constant", fmt::format("{}", 0.25 / 255)},
                                              {"image.width", in_lane("320", "1280")},
                                              {"image.height", in_lane("180", "720")}});
    expect_share(terrain, Cause::precision, 0.95, "terrain");
}

TEST(Precision, IsTheFormatsOrTheTransforms)
{
    GNOMON_REQUIRE_GL();
    std::vector<const char*> filters{"nearest", "pcf3"};
    if (runs_full_tests()) {
        filters.insert(filters.end(), {"linear", "hardware"});
    }
    const std::string width = in_lane("640", "1280");
    const std::string height = in_lane("360", "720");
    for (const char* filter : filters) {
        // The bias covers the slopes of the texels, but not the format's steps of 1/255.
        const auto coarse = compared("terrain", {{"shadow_map.resolution", "4096"},
                                                 {"shadow_map.depth_format", "u8"},
                                                 {"lookup.filter", filter},
                                                 {"bias.slope", "0.0002"},
                                                 {"bias.constant", fmt::format("{}", 0.25 / 255)},
                                                 {"image.width", width},
                                                 {"image.height", height}});
        EXPECT_GT(coarse.precision_kinds->format, 1000U) << filter;
        EXPECT_LE(coarse.precision_kinds->transform, coarse.precision_kinds->format / 100)
            << filter;
        EXPECT_EQ(coarse.precision_kinds->format + coarse.precision_kinds->transform,
                  counts_of(coarse).of(Cause::precision))
            << filter;
        // A map of floats has no error of the format.
        const auto floats = compared("terrain", {{"shadow_map.depth_format", "d32f"},
                                                 {"lookup.filter", filter},
                                                 {"image.width", width},
                                                 {"image.height", height}});
        EXPECT_EQ(floats.precision_kinds->format, 0U) << filter;
        EXPECT_EQ(floats.precision_kinds->transform, counts_of(floats).of(Cause::precision))
            << filter;
    }
}

TEST(Resolution, IsTheCauseWhereTheBiasIsHalfOfWhatCoarseTexelsNeed)
{
    GNOMON_REQUIRE_GL();
    const TiltedPlaneSetting plane{45, 256, "d32f", 0};
    const scene::Job job = tilted_plane_job(plane, 0);
    const Compared scene{job};
    const auto frustum = resolve_view(job, scene.file().scene, scene.file().defaults).first_map();
    expect_share(scene(tilted_plane_job(plane, 0.5 * closed_form_bias(plane, frustum))),
                 Cause::resolution, 0.95, "tilted-plane");
    const Keys coarse{{"shadow_map.resolution", "256"},
                      {"shadow_map.depth_format", "d32f"},
                      {"image.width", in_lane("320", "1280")},
                      {"image.height", in_lane("180", "720")}};
    const auto unbiased = compared("terrain", coarse);
    const auto needed = double{unbiased.diagnosis->biases->bounds.allowances[2].acne_free};
    Keys biased = coarse;
    biased.push_back({"bias.constant", fmt::format("{}", 0.5 * needed)});
    expect_share(compared("terrain", biased), Cause::resolution, 0.95, "terrain");
}

/// The pixels of a cause, and those that other settings of the map repair.
struct Repaired {
    std::uint64_t all = 0;
    std::uint64_t right = 0;
};

Repaired repaired(const analysis::Comparison& before, Cause cause,
                  const analysis::Comparison& after)
{
    Repaired count;
    for (std::size_t i = 0; i < before.truth.pixel_class.pixel_count(); ++i) {
        if (before.diagnosis->causes.cause[i] == cause) {
            const bool is_lit = before.truth.pixel_class[i] == scene::PixelClass::lit;
            ++count.all;
            count.right += scene::is_lit(after.lookup.samples[i].verdict) == is_lit ? 1U : 0U;
        }
    }
    return count;
}

void expect_repaired(const Repaired& count, std::uint64_t least)
{
    EXPECT_GE(count.all, least);
    EXPECT_GE(static_cast<double>(count.right), 0.9 * static_cast<double>(count.all));
}

TEST(Repair, OfABiasIsNone)
{
    GNOMON_REQUIRE_GL();
    for (const char* builtin : {"wall", "columns", "yard"}) {
        const scene::Job job = job_of(builtin, {{"bias.constant", "0.02"},
                                                {"image.width", in_lane("320", "1280")},
                                                {"image.height", in_lane("180", "720")}});
        const Compared scene{job};
        const auto before = scene(job);
        scene::Job without = job;
        without.bias = {};
        const Repaired count = repaired(before, Cause::bias, scene.without_diagnosis(without));
        EXPECT_GT(count.all, 100U) << builtin;
        EXPECT_EQ(count.right, count.all) << builtin;
    }
}

TEST(Repair, OfPrecisionIsAFloatFormat)
{
    GNOMON_REQUIRE_GL();
    const TiltedPlaneSetting plane{45, 4096, "u8", 0};
    const scene::Job job = tilted_plane_job(plane, 0);
    const Compared scene{job};
    const auto frustum = resolve_view(job, scene.file().scene, scene.file().defaults).first_map();
    const double needed = closed_form_bias({45, 4096, "d32f", 0}, frustum);
    const auto before = scene(tilted_plane_job(plane, 1.02 * needed));
    const auto after = scene(tilted_plane_job({45, 4096, "d32f", 0}, 1.02 * needed));
    expect_repaired(repaired(before, Cause::precision, after), 1000);
}

/// The finer map has a float format, so that precision is repaired too.
void expect_repaired_by_resolution(int resolution)
{
    const TiltedPlaneSetting plane{45, 256, "d24", 0};
    const scene::Job job = tilted_plane_job(plane, 0);
    const Compared scene{job};
    const TiltedPlaneSetting finer{45, resolution, "d32f", 0};
    const auto frustum = resolve_view(job, scene.file().scene, scene.file().defaults).first_map();
    const double bias = 1.02 * closed_form_bias(finer, frustum);
    expect_repaired(repaired(scene(tilted_plane_job(plane, bias)), Cause::resolution,
                             scene.without_diagnosis(tilted_plane_job(finer, bias))),
                    1000);
}

TEST(Repair, OfResolutionIsAFinerMap)
{
    GNOMON_REQUIRE_GL();
    expect_repaired_by_resolution(8192);
}

/// Long because its map takes 1 GiB.
TEST(LongRepair, OfResolutionIsTheFinestMap)
{
    GNOMON_REQUIRE_GL();
    expect_repaired_by_resolution(16384);
}

TEST(Repair, OfCoverageIsTheWholeScene)
{
    GNOMON_REQUIRE_GL();
    const Keys common{{"bias.constant", "0.001"}, {"shadow_map.resolution", "4096"}};
    for (const auto& [key, value] :
         {std::pair{"shadow_map.near", "8"}, std::pair{"shadow_map.cull", "front"}}) {
        Keys changed = common;
        changed.push_back({key, value});
        const scene::Job job = job_of("sphere-plane", changed);
        const Compared scene{job};
        const Repaired count = repaired(scene(job), Cause::coverage,
                                        scene.without_diagnosis(job_of("sphere-plane", common)));
        if (count.all > 0) {
            expect_repaired(count, 1);
        } else {
            EXPECT_STREQ(key, "shadow_map.cull"); // the sphere's far side casts the same shadow
        }
    }
}

void expect_every_combination_explained(const std::string& builtin, const Keys& size)
{
    const Compared scene{job_of(builtin, size)};
    std::size_t filters = builtin.size();
    for (const char* filter : {"nearest", "linear", "hardware", "pcf3", "pcf5"}) {
        std::size_t number = filters++;
        for (const char* outside : {"lit", "shadowed", "clamp"}) {
            ++number;
            for (const auto& [cull, bias] :
                 {std::pair{"none", "0"}, {"front", "0.0005"}, {"back", "0.02"}}) {
                if (!runs_full_tests() && number++ % 3 != 0) {
                    continue; // the usual lane tries each pair of values once
                }
                Keys keys = size;
                keys.push_back({"lookup.filter", filter});
                keys.push_back({"lookup.outside", outside});
                keys.push_back({"shadow_map.cull", cull});
                keys.push_back({"bias.constant", bias});
                expect_all_explained(
                    scene(job_of(builtin, keys)),
                    fmt::format("{} {} {} {} {}", builtin, filter, outside, cull, bias));
            }
        }
    }
}

const Keys small{{"image.width", "240"}, {"image.height", "135"}, {"shadow_map.resolution", "256"}};

TEST(Causes, EveryWrongPixelHasOneWhateverFilterBorderAndCulling)
{
    GNOMON_REQUIRE_GL();
    for (const char* builtin : {"sphere-cube", "wall"}) {
        expect_every_combination_explained(builtin, small);
    }
}

TEST(LongCauses, EveryWrongPixelOfEveryBuiltinHasOne)
{
    GNOMON_REQUIRE_GL();
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        expect_every_combination_explained(builtin.name, small);
    }
}

} // namespace
} // namespace gnomon::tests
