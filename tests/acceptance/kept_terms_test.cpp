#include "compared.hpp"
#include "expectations.hpp"
#include "lane.hpp"
#include "method_case.hpp"
#include "methods_job.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Causes under bias terms beside constant and slope, and far from the origin: the errors
/// attributed to precision are those that exact depths, or positions, repair.
namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Comparison;
using Keys = std::vector<scene::Override>;

/// The yard, with a depth range far too long for 16 bits. Each term covers the slope of the texels,
/// but not the steps of the format.
const Keys long_range{{"image.width", "160"},
                      {"image.height", "90"},
                      {"shadow_map.near", "-2000"},
                      {"shadow_map.far", "2000"},
                      {"shadow_map.resolution", "2048"},
                      {"bias.constant", "0"},
                      {"bias.slope", "0"}};

const std::vector<Keys> terms{
    {{"bias.slope_kernels", "1"}},
    {{"bias.polygon_offset_factor", "1.5"}},
    {{"bias.normal_texels", "1"}},
    {{"bias.normal_m", "0.02"}},
    {{"bias.constant_texels", "1"}},
    {{"bias.receiver_plane", "analytic"}, {"bias.constant_texels", "0.25"}},
    {{"bias.adaptive_m", "0.01"}},
};

/// The first terms also cover the slope of a kernel's texels. With the others a kernel has acne
/// from that slope, which no format cures.
constexpr std::size_t terms_for_kernels = 4;

double error_of(const Comparison& result)
{
    return result.metrics.amounts.shadow + result.metrics.amounts.light;
}

TEST(KeptTerms, LayToPrecisionWhatAFormatOfFloatsCures)
{
    GNOMON_REQUIRE_GL();
    const auto job_of = [](const Keys& keys) {
        return tests::builtin_job("yard", with(long_range, keys)).job;
    };
    const Compared yard{job_of({})};
    for (const char* const filter : {"nearest", "pcf3", "hardware"}) {
        const bool is_kernel = std::string_view{filter} != "nearest";
        for (std::size_t i = 0; i < (is_kernel ? terms_for_kernels : terms.size()); ++i) {
            const std::size_t usual = i >= terms_for_kernels ? 0 : 1 + i % 2;
            const std::size_t kind = !is_kernel ? 0 : *filter == 'p' ? 1 : 2;
            if (!runs_full_tests() && kind != usual) {
                continue; // the usual lane tries each term with one filter
            }
            const Keys& term = terms[i];
            const auto keys = with(term, {{"lookup.filter", filter}});
            SCOPED_TRACE(fmt::format("{} {}", term.front().key, filter));
            const Comparison coarse =
                yard(job_of(with(keys, {{"shadow_map.depth_format", "d16"}})));
            const Comparison fine = yard(job_of(with(keys, {{"shadow_map.depth_format", "d32f"}})));
            const double cured = error_of(coarse) - error_of(fine);
            const double laid = coarse.diagnosis->causes.amounts.of(Cause::precision);
            EXPECT_GT(laid, 200);
            EXPECT_GE(cured, 0.5 * laid);
            EXPECT_GE(laid, 0.5 * cured);
            EXPECT_GT(coarse.precision_kinds->format, coarse.precision_kinds->transform);
        }
    }
}

/// A house on a ground. All coordinates are whole metres.
scene::SceneFile site(const scene::Vec3d& origin)
{
    using Corners = std::vector<scene::Vec3d>;
    using Faces = std::vector<std::array<std::uint32_t, 3>>;
    scene::SceneBuilder builder;
    const auto at = [&](double x, double y, double z) { return origin + scene::Vec3d{x, y, z}; };
    builder.add("ground", Corners{at(-15, 0, 15), at(15, 0, 15), at(15, 0, -15), at(-15, 0, -15)},
                Faces{{0, 1, 2}, {0, 2, 3}});
    Corners corners;
    for (const double x : {-4.0, 4.0}) {
        for (const double y : {0.0, 6.0}) {
            for (const double z : {-3.0, 3.0}) {
                corners.push_back(at(x, y, z));
            }
        }
    }
    builder.add("house", corners,
                Faces{{0, 1, 3},
                      {0, 3, 2},
                      {4, 6, 7},
                      {4, 7, 5},
                      {0, 4, 5},
                      {0, 5, 1},
                      {2, 3, 7},
                      {2, 7, 6},
                      {0, 2, 6},
                      {0, 6, 4},
                      {1, 5, 7},
                      {1, 7, 3}});
    return {builder.take(), {}};
}

Comparison seen_at(const scene::Vec3d& origin, const char* filter)
{
    scene::Job job = tests::builtin_job("yard", {{"lookup.filter", filter},
                                                 {"shadow_map.resolution", "2048"},
                                                 {"shadow_map.depth_format", "d32f"},
                                                 {"bias.constant_m", "0.05"}})
                         .job;
    job.image = {320, 180};
    job.camera = scene::CameraSettings{.eye = origin + scene::Vec3d{14, 9, 18},
                                       .target = origin + scene::Vec3d{0, 2, 0}};
    job.light = scene::LightSettings{};
    job.light->type = scene::LightType::directional;
    job.light->direction = scene::Vec3d{-0.6, -1, -0.5};
    job.shadow_map.frustum = {};
    Comparison result = Compared{site(origin)}(job);
    result.triangles = nullptr; // the scene is gone
    return result;
}

/// At 1.7 and 8.2 thousand kilometres float32 has steps of 0.125 and 0.5 m; whole metres are exact.
TEST(DisplacedLookups, ArePrecisionByTheTransformsFarFromTheOrigin)
{
    GNOMON_REQUIRE_GL();
    for (const char* const filter : {"nearest", "pcf3", "linear"}) {
        SCOPED_TRACE(filter);
        const Comparison near = seen_at({0, 0, 0}, filter);
        const Comparison far = seen_at({1661274, 17, -8178659}, filter);
        const auto wrong = [](const Comparison& result) {
            return result.metrics.false_shadow + result.metrics.false_lit;
        };
        const auto of_precision = [](const Comparison& result) {
            return result.diagnosis->causes.counts.of(Cause::precision);
        };
        const std::uint64_t more = wrong(far) - wrong(near);
        EXPECT_GT(wrong(far), wrong(near) + 10);
        EXPECT_GE(2 * of_precision(far), more);
        EXPECT_GT(far.precision_kinds->transform, 9 * far.precision_kinds->format);
        EXPECT_LE(of_precision(near), wrong(near));
    }
}

/// Each job's biases reach this many texels and this length.
TEST(Gaps, AreNoLongerThanTheBiasesReach)
{
    GNOMON_REQUIRE_GL();
    struct Reach {
        Keys keys;
        double texels;
        double length_m;
    };
    const std::vector<Reach> all{
        {{{"bias.normal_texels", "2"}}, 2, 0},
        {{{"bias.constant_m", "0.05"}}, 0, 0.05},
        {{{"bias.constant_m", "0.05"}, {"shadow_map.cull", "front"}}, 0, 0.05},
        {{{"bias.normal_texels", "2"}, {"bias.constant_m", "0.05"}}, 2, 0.05},
        {{{"bias.constant_texels", "1.5"}, {"shadow_map.reversed", "true"}}, 1.5, 0},
    };
    std::size_t measured = 0;
    for (const char* const builtin : {"yard", "columns"}) {
        for (const Reach& reach : all) {
            const Keys keys = with({{"image.width", "240"},
                                    {"image.height", "135"},
                                    {"light.type", "directional"},
                                    {"shadow_map.resolution", "512"},
                                    {"bias.constant_m", "0"}},
                                   reach.keys);
            const scene::Job job = tests::builtin_job(builtin, keys).job;
            SCOPED_TRACE(fmt::format("{} {}", builtin, reach.keys.front().key));
            const Comparison result = Compared{job}(job);
            const double texel_m = result.view.first_map().texel_width_m(1, 512);
            // A float32's roundings of the length, of the pixel's depth and of the sum.
            const double most_m = (1 + 0x1p-20) * (reach.texels * texel_m + reach.length_m);
            if (!result.diagnosis->peter_panning.metres) {
                continue; // the bias is too short to detach a pixel's shadow
            }
            ++measured;
            EXPECT_LE(double{result.diagnosis->peter_panning.metres->max}, most_m);
            EXPECT_GT(double{result.diagnosis->peter_panning.metres->max}, 0);
        }
    }
    EXPECT_GT(measured, all.size()) << "of twice as many";
}

} // namespace
} // namespace gnomon::tests
