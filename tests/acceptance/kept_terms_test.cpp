#include "compared.hpp"
#include "expectations.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

/// Causes under bias terms beside constant and slope: what is laid to precision is what exact depths
/// repair.
namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Comparison;
using Keys = std::vector<scene::Override>;

Keys with(Keys keys, const Keys& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

/// A yard whose depth range is far too long for 16 bits, with one term that covers the slope of its
/// texels, not the steps of the format.
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

double error_of(const Comparison& result)
{
    return result.metrics.amounts.shadow + result.metrics.amounts.light;
}

TEST(KeptTerms, LayToPrecisionWhatAFormatOfFloatsCures)
{
    GNOMON_REQUIRE_GL();
    const auto job_of = [](const Keys& keys) {
        return scene::builtin_job("yard", with(long_range, keys)).job;
    };
    const Compared yard{job_of({})};
    for (const char* const filter : {"nearest", "pcf3", "hardware"}) {
        for (const Keys& term : terms) {
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

} // namespace
} // namespace gnomon::tests
