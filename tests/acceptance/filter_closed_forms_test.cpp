#include "analysis/lookup/taps.hpp"
#include "closed_form.hpp"
#include "compared.hpp"
#include "lane.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/settings/filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <span>

/// A plane's acne has a closed form for every filter, by amount and by count: the receiver's depth
/// minus the tap's is g·(p − c), with the plane's depth per texel g, the receiver's place p and the
/// tap's centre c.
namespace gnomon::tests {
namespace {

using scene::Filter;

/// Half a step of float32 below 1, and the roundings of r and d, a few times 2^-24.
constexpr double rounding = 0x1p-25 + 4 * 0x1p-24;

/// Lit pixels sample the phases of texels. Their mean errs by the share of texels that the
/// picture's border cuts.
constexpr double phase_sampling = 0.005;

/// The error of a driver that interpolates between snapped corners: for receiver and tap, the depth
/// of half a step of its grid along both axes.
double snapping(double depth_per_texel)
{
    const scene::RasterModel model = raster_model();
    return model.interpolates_from_snapped ? std::ldexp(depth_per_texel, -model.subpixel_bits)
                                           : 0.0;
}

scene::Job job_of(const TiltedPlaneSetting& setting, Filter filter, double bias)
{
    scene::Job job = tilted_plane_job(setting, bias);
    job.lookup.filter = filter;
    return job;
}

/// The larger and the smaller of |cos φ| and |sin φ|.
struct Shares {
    double larger;
    double smaller;
};
Shares shares_of(const TiltedPlaneSetting& setting)
{
    const double roll_rad = setting.roll_deg * std::numbers::pi / 180;
    const double cosine = std::abs(std::cos(roll_rad));
    const double sine = std::abs(std::sin(roll_rad));
    return {std::max(cosine, sine), std::min(cosine, sine)};
}

/// The mean amount of a lit pixel with a constant bias of β times the plane's depth across the
/// filter: the share of g·p above the bias, with p uniform over a square of K texels.
double mean_amount(const Shares& shares, double beta)
{
    const double c = shares.larger;
    const double s = shares.smaller;
    if (beta <= (c - s) / 2) {
        return 0.5 - beta / c;
    }
    const double rest = std::max(0.0, (c + s) / 2 - beta);
    return s == 0 ? 0 : rest * rest / (2 * c * s);
}

void expect_ends(const analysis::Comparison& result, const TiltedPlaneSetting& setting, int width)
{
    const double half = half_texel_slope(setting, result.view.first_map());
    const auto& strict = result.diagnosis->biases->bounds.strict;
    // If the plane falls along both axes, few pixels meet a texel's corner. The nearest misses it
    // by a part of a texel, for any filter width.
    const double missed_of_a_texel = setting.roll_deg == 0 ? 0.001 : 0.005;
    const auto expect = [&](double found, int texels, const char* name) {
        const double closed = texels * half;
        EXPECT_GE(found, closed - missed_of_a_texel * half - rounding) << name;
        EXPECT_LE(found, closed * 1.001 + rounding) << name;
    };
    expect(double{strict.acne_free}, width, "acne_free");
    expect(double{strict.acne_free_count}, 1, "acne_free_count");
}

/// The amount of false shadow with another bias in the same map.
class AmountAt {
public:
    AmountAt(const Compared& compared, const analysis::Comparison& result)
        : compared_{compared},
          result_{result},
          drawn_{compared.drawn(result.job, result.view)}
    {
    }

    [[nodiscard]] double operator()(double bias) const
    {
        scene::View biased = result_.view;
        biased.bias = {.constant = static_cast<float>(bias)};
        const auto lookup = compared_.renderers().rasterizer.look_up({drawn_, result_.job, biased});
        const int taps = methods::filter_traits(result_.job.lookup.filter).equal_taps();
        return analysis::measure(result_.truth, lookup, taps).shadow_amount_rate.value();
    }

private:
    const Compared& compared_;
    const analysis::Comparison& result_;
    renderers::Drawn drawn_;
};

void expect_amounts(const Compared& compared, const analysis::Comparison& result,
                    const TiltedPlaneSetting& setting, Filter filter)
{
    const double half = half_texel_slope(setting, result.view.first_map());
    const AmountAt amount_at{compared, result};
    const Shares shares = shares_of(setting);
    const double across =
        methods::filter_traits(filter).width_texels * 2 * half / (shares.larger + shares.smaller);
    for (const double beta : {0.0, 0.1, 0.25, 0.4, 0.6}) {
        EXPECT_NEAR(amount_at(beta * across), mean_amount(shares, beta), phase_sampling)
            << "β = " << beta;
    }
}

/// Checks every tap of every lit pixel.
void expect_tap_criticals(const Compared& compared, const analysis::Comparison& result)
{
    const PlaneDepth depth{result};
    const auto map = compared.drawn(result.job, result.view).map->map().depths();
    const auto rule = analysis::lookup_rule(result.job, result.view);
    const analysis::TapCriticals taps{result.lookup, map, rule};
    const analysis::Footprint footprint{rule.traits, rule.edge(), map.size().width_px};
    double largest = 0;
    taps.visit(
        0, result.truth.pixel_class.pixel_count(),
        [&](std::size_t i) { return result.truth.pixel_class[i] == scene::PixelClass::lit; },
        [&](std::size_t i, std::span<const float> criticals) {
            const scene::MapPoint at = result.lookup.at(i);
            std::size_t t = 0;
            footprint.visit_taps(at, [&](const analysis::Tap& tap) {
                const double here = depth(double{at.texel.x}, double{at.texel.y});
                const double there = depth(tap.texel.x + 0.5, tap.texel.y + 0.5);
                const double off = double{criticals[t++]} - (here - there);
                largest = tap.is_inside ? std::max(largest, std::abs(off)) : largest;
            });
        });
    // uv·res is a float32, so p has an error of half its spacing along both axes.
    const double place = 0x1p-24 * map.size().width_px * depth.per_texel();
    EXPECT_LE(largest, rounding + place + snapping(depth.per_texel()));
}

void expect_closed_forms(const TiltedPlaneSetting& setting, const Compared& compared,
                         std::span<const Filter> filters)
{
    SCOPED_TRACE(text(setting));
    for (const Filter filter : filters) {
        SCOPED_TRACE(scene::filter_name(filter));
        const auto result = compared(job_of(setting, filter, 0));
        ASSERT_GE(result.metrics.pixels.of(scene::PixelClass::lit), 500000U);
        expect_ends(result, setting, methods::filter_traits(filter).width_texels);
        expect_tap_criticals(compared, result);
        expect_amounts(compared, result, setting, filter);
    }
}

/// Between texel centres the interpolated depth is that of the plane.
void expect_linear_ends_at_rounding(const TiltedPlaneSetting& setting, const Compared& compared)
{
    SCOPED_TRACE(text(setting));
    const auto result = compared(job_of(setting, Filter::linear, 0));
    // GL's weights have at least 8 bits of fraction, which displaces the lookup by 1/512 of a
    // texel.
    const double per_texel = 2 * half_texel_slope(setting, result.view.first_map());
    const double weights = shader_arithmetic_is_ieee() ? 0.0 : std::ldexp(per_texel, -9);
    EXPECT_LE(double{result.diagnosis->biases->bounds.strict.acne_free},
              4 * rounding + weights + snapping(per_texel));
}

void expect_hardware(const TiltedPlaneSetting& setting, const Compared& compared)
{
    SCOPED_TRACE(text(setting));
    const auto without = compared.without_diagnosis(job_of(setting, Filter::hardware, 0));
    const double across = 2 * half_texel_slope(setting, without.view.first_map());
    const AmountAt amount_at{compared, without};
    EXPECT_EQ(amount_at(1.001 * across + rounding), 0);
    EXPECT_GT(amount_at(0.8 * across), 0);
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
        if (setting.roll_deg == 0) {
            // GL's weights have at least 8 bits of fraction.
            EXPECT_NEAR(amount_at(part * across), (1 - part) * (1 - part) / 2,
                        phase_sampling + 1.0 / 256)
                << part;
        }
    }
}

/// @param filters  Those of K × K texels.
void expect_all(const TiltedPlaneSetting& setting, std::initializer_list<Filter> filters)
{
    const Compared compared{tilted_plane_job(setting, 0)};
    expect_closed_forms(setting, compared, filters);
    expect_linear_ends_at_rounding(setting, compared);
    expect_hardware(setting, compared);
}

TEST(FilterClosedForms, HoldForAPlaneUprightAndRolled)
{
    GNOMON_REQUIRE_GL();
    // The time of exact causes grows with the taps, so the usual lane tries smaller filters.
    expect_all({60, 512, "d32f", 0}, {in_lane(Filter::pcf5, Filter::pcf9)});
    expect_all({35, 1024, "d32f", 30}, {in_lane(Filter::pcf3, Filter::pcf5)});
}

class LongFilterClosedForms : public testing::TestWithParam<int> {};

TEST_P(LongFilterClosedForms, HoldForRollsAndResolutions)
{
    GNOMON_REQUIRE_GL();
    for (const double roll_deg : {0.0, 15.0, 30.0, 45.0}) {
        for (const int resolution : {512, 2048}) {
            expect_all({GetParam(), resolution, "d32f", roll_deg},
                       {Filter::pcf3, Filter::pcf5, Filter::pcf9});
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AngleDeg, LongFilterClosedForms, testing::Values(10, 25, 40, 55, 70, 85));

} // namespace
} // namespace gnomon::tests
