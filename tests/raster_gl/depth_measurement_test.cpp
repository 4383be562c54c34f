#include "gl_case.hpp"

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_error.hpp"
#include "analysis/depth/depth_plan.hpp"
#include "analysis/depth/measured_error.hpp"
#include "lane.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/map/raster_planes.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

/// Compares the depths that GL stores for planes at known distances with the formulas.
namespace gnomon::raster_gl {
namespace {

using analysis::DepthCoding;
using analysis::DepthErrorRow;
using analysis::DepthMapping;
using analysis::MeasuredDepthError;
using analysis::TexelClass;
using scene::ClipRange;
using scene::DepthFormat;
using scene::MeasuredPlaneSettings;
using scene::Projection;

DepthFormat format_of(const std::string& name)
{
    return scene::depth_format_from_name(name).value();
}

/// The textbook lesson's frustum.
MeasuredPlaneSettings lesson_planes(int count)
{
    MeasuredPlaneSettings settings;
    settings.range = {Projection::perspective, 4, 50, false, {}};
    settings.count = count;
    return settings;
}

MeasuredDepthError measured(const MeasuredPlaneSettings& settings, const std::string& format)
{
    const scene::MeasuredPlanes planes = scene::make_measured_planes(settings);
    RasterPlanes raster{*tests::shared_context(), planes};
    const DepthMapping mapping{settings.content, settings.range};
    return analysis::measured_depth_error(mapping, raster.measure(format_of(format)));
}

/// GL's own formats and the colour formats.
std::vector<std::string> supported_formats()
{
    std::vector<std::string> names{"r32f", "r16f", "rgba8"};
    for (const FormatSupport& format : query_depth_formats(*tests::shared_context())) {
        if (format.supported) {
            names.push_back(format.name);
        }
    }
    return names;
}

TEST(DepthMeasurement, OfD16IsTheSawtooth)
{
    GNOMON_REQUIRE_GL();
    constexpr int count = 1 << 16;
    const MeasuredDepthError error = measured(lesson_planes(count), "d16");
    EXPECT_EQ(error.missing, 0U);
    ASSERT_EQ(error.rows.size(), std::size_t{count});
    // Within the format's bound: one of the two codes nearest to the plane that GL drew.
    EXPECT_EQ(error.certificate.count(TexelClass::nearest_code) +
                  error.certificate.count(TexelClass::within_format),
              std::size_t{count});
    std::size_t same = 0;
    for (const DepthErrorRow& row : error.rows) {
        same += row.code == row.formula_code ? 1 : 0;
        ASSERT_LE(std::abs(row.error_m), row.model_m) << row.light_distance_m;
    }
    // Float32 evaluation moves d by some 2^-23, 1/128 code, on either side of each tie.
    EXPECT_GT(same, count * 95U / 100);
    EXPECT_NEAR(error.max_error_m, 4.3866e-3, 0.02 * 4.3866e-3);
}

TEST(DepthMeasurement, OfD16IsZeroAtTheDistancesOfItsCodes)
{
    GNOMON_REQUIRE_GL();
    // The last metre has 44 codes of 8.8 mm: at 2^18 samples, a code every 50 or so.
    MeasuredPlaneSettings settings = lesson_planes(1 << 18);
    const MeasuredDepthError error = measured(settings, "d16");
    const DepthMapping mapping{settings.range};
    const DepthCoding coding = DepthCoding::unorm(16);
    const double spacing_m = 46.0 / ((1 << 18) - 1);
    std::size_t zeros = 0;
    for (std::size_t i = 1; i < error.rows.size(); ++i) {
        const DepthErrorRow& before = error.rows[i - 1];
        const DepthErrorRow& after = error.rows[i];
        const bool crosses = before.code == after.code && before.error_m >= 0 && after.error_m < 0;
        if (!crosses || before.light_distance_m < 20) { // nearer, a tooth has fewer than 8 samples
            continue;
        }
        const double zero_m = analysis::exact_distance_m(mapping, coding, before.code);
        ASSERT_GE(zero_m, before.light_distance_m - spacing_m);
        ASSERT_LE(zero_m, after.light_distance_m + spacing_m);
        ++zeros;
    }
    // Codes between 20 and 50 m: 65535·(d(50) − d(20)) = 8548.
    EXPECT_NEAR(static_cast<double>(zeros), 8548, 10);
}

TEST(DepthMeasurement, ExcessOverTheFormulaIsBoundedByTheDriverModel)
{
    GNOMON_REQUIRE_GL();
    for (const std::string& format : supported_formats()) {
        for (const double tilt_deg : {0.0, 60.0}) {
            for (const double offset_m : {0.0, 100.0}) {
                MeasuredPlaneSettings settings = lesson_planes(tests::in_lane(1 << 14, 1 << 18));
                settings.tilt_rad = glm::radians(tilt_deg);
                settings.offset_m = offset_m;
                const MeasuredDepthError error = measured(settings, format);
                const auto where = fmt::format("{} tilt {} offset {}", format, tilt_deg, offset_m);
                EXPECT_EQ(error.certificate.count(TexelClass::outside), 0U) << where;
                EXPECT_LE(error.max_share_of_model, 1) << where;
                EXPECT_LT(error.missing, error.rows.size() / 100) << where;
                if (format == "d24" || format == "d32" || format == "d32f") {
                    EXPECT_GT(error.max_excess_m, 0) << where; // shown, never hidden
                }
            }
        }
    }
}

TEST(DepthMeasurement, OfDistancesStaysWithinTheModelAndTheFormulasEnvelope)
{
    GNOMON_REQUIRE_GL();
    std::vector<std::string> formats = supported_formats();
    formats.emplace_back("u8");
    for (const std::string& format : formats) {
        for (const double tilt_deg : {0.0, 60.0, 80.0}) {
            for (const double offset_m : {0.0, 100.0}) {
                MeasuredPlaneSettings settings = lesson_planes(tests::in_lane(1 << 13, 1 << 18));
                settings.content = scene::MapContent::distance;
                settings.tilt_rad = glm::radians(tilt_deg);
                settings.offset_m = offset_m;
                const MeasuredDepthError error = measured(settings, format);
                const auto where = fmt::format("{} tilt {} offset {}", format, tilt_deg, offset_m);
                EXPECT_EQ(error.certificate.count(TexelClass::outside), 0U) << where;
                EXPECT_LE(error.max_share_of_model, 1) << where;
                EXPECT_LT(error.missing, error.rows.size() / 100) << where;
                // The far end loses half a metre of 50, as a corner is nearer to far.
                EXPECT_LT(error.rows.front().light_distance_m, 4.7) << where;
                EXPECT_GT(error.rows.back().light_distance_m, 45) << where;
                if (format == "r16f" || format == "rgba8" || format == "u8") {
                    // The error of float32, 1e-5 m, is far below the format's.
                    EXPECT_LT(error.max_excess_m, 1e-4) << where;
                }
            }
        }
    }
}

TEST(DepthMeasurement, OfRoundedAndPackedDepthsIsTheFormulas)
{
    GNOMON_REQUIRE_GL();
    for (const auto content : {scene::MapContent::depth, scene::MapContent::distance}) {
        for (const char* format : {"r16f", "rgba8"}) {
            MeasuredPlaneSettings settings = lesson_planes(1 << 14);
            settings.content = content;
            const MeasuredDepthError error = measured(settings, format);
            double formulas_m = 0;
            for (const DepthErrorRow& row : error.rows) {
                formulas_m = std::max(formulas_m, std::abs(row.formula_error_m));
            }
            EXPECT_NEAR(error.max_error_m, formulas_m, 0.02 * formulas_m) << format;
        }
    }
}

/// Frusta whose depths lie near 0 and 1, in each direction and clip range.
std::vector<scene::DepthRange> ranges_near_the_ends_of_depth()
{
    std::vector<scene::DepthRange> ranges;
    for (const auto& [near_m, far_m] : {std::pair{4.0, 50.0}, {0.1, 1000.0}, {1.0, 1e6}}) {
        for (const bool reversed : {false, true}) {
            for (const auto clip : {ClipRange::minus_one_to_one, ClipRange::zero_to_one}) {
                ranges.push_back({Projection::perspective, near_m, far_m, reversed, clip});
            }
        }
    }
    return ranges;
}

TEST(DepthMeasurement, LeavesTheDriverModelNowhereNearTheEndsOfDepth)
{
    GNOMON_REQUIRE_GL();
    for (const scene::DepthRange& range : ranges_near_the_ends_of_depth()) {
        for (const std::string& format : supported_formats()) {
            MeasuredPlaneSettings settings = lesson_planes(tests::in_lane(1 << 12, 1 << 18));
            settings.range = range;
            const MeasuredDepthError error = measured(settings, format);
            const auto where =
                fmt::format("{} near {} far {} reversed {} clip {}", format, range.near_m,
                            range.far_m, range.reversed, static_cast<int>(range.clip_range));
            EXPECT_EQ(error.certificate.count(TexelClass::outside), 0U) << where;
            EXPECT_LE(error.certificate.largest_share_of_bound, 1) << where;
            EXPECT_LE(error.max_share_of_model, 1) << where;
        }
    }
}

TEST(DepthMeasurement, LeavesOutTexelsThatFloat32MovedAnotherPlaneOver)
{
    GNOMON_REQUIRE_GL();
    // At 100 m float32 moves corners by 4e-6 m, some 15 texels of 4 at the near plane.
    MeasuredPlaneSettings settings;
    settings.range = {Projection::perspective, 1e-3, 10, false, ClipRange::zero_to_one};
    settings.count = 2048;
    settings.tilt_rad = glm::radians(80.0);
    settings.offset_m = 100;
    const MeasuredDepthError error = measured(settings, "d24");
    EXPECT_EQ(error.certificate.count(TexelClass::outside), 0U);
    EXPECT_GT(error.missing, 0U);
    EXPECT_LT(error.missing, 20U);
    settings.range = {Projection::perspective, 1e-3, 2e-3, false, {}};
    settings.offset_m = 500;
    settings.tilt_rad = 0;
    EXPECT_THROW((void)measured(settings, "d24"), scene::InputError);
}

TEST(DepthMeasurement, Of32BitsOnLlvmpipeIsADoubledSignedInteger)
{
    GNOMON_REQUIRE_GL();
    const auto names = supported_formats();
    if (!tests::shader_arithmetic_is_ieee() || std::ranges::find(names, "d32") == names.end()) {
        GTEST_SKIP() << "another driver converts in another way, or has no d32";
    }
    std::size_t below_gl = 0;
    for (const scene::DepthRange& range : ranges_near_the_ends_of_depth()) {
        MeasuredPlaneSettings settings = lesson_planes(1 << 12);
        settings.range = range;
        const scene::MeasuredPlanes planes = scene::make_measured_planes(settings);
        RasterPlanes raster{*tests::shared_context(), planes};
        const auto integers = raster.measure(format_of("d32")).samples;
        const auto floats = raster.measure(format_of("d32f")).samples;
        ASSERT_EQ(integers.size(), floats.size());
        for (std::size_t i = 0; i < floats.size(); ++i) {
            const auto depth = std::bit_cast<float>(floats[i].texel.code);
            const auto truncated = static_cast<std::uint32_t>(depth * 0x1p31F);
            const std::uint32_t code = integers[i].texel.code;
            ASSERT_EQ(code, 2 * truncated - (truncated >> 31U)) << std::hexfloat << depth;
            if (code < analysis::nearest_codes(DepthCoding::unorm(32), depth).lower) {
                ++below_gl;
            }
        }
    }
    EXPECT_GT(below_gl, 1000U); // GL does not allow these, so the model must
}

TEST(DepthMeasurement, TransformsErrorStaysBelowTheTheorysBound)
{
    GNOMON_REQUIRE_GL();
    for (const bool reversed : {false, true}) {
        for (const double offset_m : {0.0, 100.0, 500.0}) {
            MeasuredPlaneSettings settings;
            settings.range = {Projection::perspective, 0.1, 100, reversed,
                              reversed ? ClipRange::zero_to_one : ClipRange::minus_one_to_one};
            settings.count = 1 << 13;
            settings.offset_m = offset_m;
            const DepthMapping mapping{settings.range};
            for (const DepthErrorRow& row : measured(settings, "d32f").rows) {
                // The camera looks along an axis: S has the camera's and the vertex's coordinate.
                const double row_sum_m = offset_m + std::abs(offset_m - row.light_distance_m);
                ASSERT_LE(std::abs(row.transform_error_m),
                          analysis::transform_error_m(
                              mapping, analysis::TransformOrder::premultiplied,
                              row.light_distance_m, std::max(row_sum_m, row.light_distance_m)))
                    << "offset " << offset_m << " light distance " << row.light_distance_m;
            }
        }
    }
}

TEST(DepthMeasurement, WorksReversedAndInEitherClipRange)
{
    GNOMON_REQUIRE_GL();
    for (const auto projection : {Projection::perspective, Projection::orthographic}) {
        for (const bool reversed : {false, true}) {
            for (const auto clip : {ClipRange::minus_one_to_one, ClipRange::zero_to_one}) {
                for (const char* format : {"d16", "d32f", "u12"}) {
                    MeasuredPlaneSettings settings = lesson_planes(1 << 12);
                    settings.range = {projection, 4, 50, reversed, clip};
                    const MeasuredDepthError error = measured(settings, format);
                    const auto where = fmt::format(
                        "{} {} reversed {} clip {}", format,
                        projection == Projection::perspective ? "perspective" : "orthographic",
                        reversed, static_cast<int>(clip));
                    EXPECT_EQ(error.rows.size(), std::size_t{1 << 12}) << where;
                    EXPECT_EQ(error.certificate.count(TexelClass::outside), 0U) << where;
                    EXPECT_LE(error.max_share_of_model, 1) << where;
                }
            }
        }
    }
}

TEST(DepthMeasurement, OfReversedFloatStaysBelowFarTimesTwoToMinus26AndTheTransformsError)
{
    GNOMON_REQUIRE_GL();
    MeasuredPlaneSettings settings = lesson_planes(1 << 18);
    settings.range = {Projection::perspective, 4, 50, true, ClipRange::zero_to_one};
    const MeasuredDepthError error = measured(settings, "d32f");
    for (const DepthErrorRow& row : error.rows) {
        // Storing: f·2^-26 = 7.45e-7 m. Transform and division, stated by the theory for a camera
        // at the origin.
        const double bound_m =
            50 * 0x1p-26 +
            analysis::gl_error_bound_m(DepthMapping{settings.range}, DepthCoding::float32(),
                                       row.light_distance_m) -
            row.envelope_m;
        ASSERT_LE(std::abs(row.error_m), bound_m) << row.light_distance_m;
    }
    settings.range.clip_range = ClipRange::minus_one_to_one;
    settings.range.reversed = false;
    // Reversed depth in [0, 1] must beat standard float depth on the same planes.
    EXPECT_LT(error.max_error_m, 0.25 * measured(settings, "d32f").max_error_m);
}

TEST(DepthMeasurement, OfAnOrthographicD16SpreadsEvenlyOverACode)
{
    GNOMON_REQUIRE_GL();
    MeasuredPlaneSettings settings = lesson_planes(1 << 16);
    settings.range.projection = Projection::orthographic;
    const MeasuredDepthError error = measured(settings, "d16");
    const double step_m = 46.0 / 65535;
    // 2^16 samples give the deviation to some 0.2 %; float32 evaluation adds 1/128 of a step.
    EXPECT_NEAR(error.standard_deviation_m, step_m / std::sqrt(12.0),
                0.02 * step_m / std::sqrt(12.0));
    EXPECT_LE(error.max_error_m, step_m);
    EXPECT_LT(std::abs(error.mean_error_m), 0.02 * step_m);
}

TEST(DepthMeasurement, AnswersOfThePlanHold)
{
    GNOMON_REQUIRE_GL();
    for (const double max_error_m : {0.01, 0.1}) {
        for (const auto projection : {Projection::perspective, Projection::orthographic}) {
            for (const auto& answer : analysis::plan_depth({projection, max_error_m, 200, {}})) {
                if (!answer.near_m) {
                    continue;
                }
                MeasuredPlaneSettings settings;
                settings.range = answer.format.range(projection, *answer.near_m, 200);
                settings.count = 1 << 14;
                const MeasuredDepthError error = measured(settings, answer.format.name);
                EXPECT_LE(error.max_error_m, max_error_m)
                    << answer.format.name << " near " << *answer.near_m;
                EXPECT_LE(error.max_error_m, answer.error_at_far_m) << answer.format.name;
                if (answer.format.name == "d16" && projection == Projection::perspective) {
                    // Either code is allowed, but the nearest is stored, so half of the bound must
                    // occur.
                    EXPECT_GE(error.max_error_m, 0.45 * max_error_m);
                }
            }
        }
    }
}

TEST(LongDepthMeasurement, HoldsAMillionPlanesInOneDraw)
{
    GNOMON_REQUIRE_GL();
    const MeasuredDepthError error = measured(lesson_planes(1 << 20), "d24");
    EXPECT_EQ(error.rows.size() + error.missing, std::size_t{1 << 20});
    EXPECT_EQ(error.certificate.count(TexelClass::outside), 0U);
}

} // namespace
} // namespace gnomon::raster_gl
