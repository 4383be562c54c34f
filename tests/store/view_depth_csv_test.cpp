#include "store/csv/view_depth_csv.hpp"

#include "csv_table.hpp"
#include "example_comparison.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

namespace gnomon::store {
namespace {

double number(const std::map<std::string, std::string>& row, const std::string& column)
{
    return std::stod(row.at(column));
}

struct Counts {
    double lit = 0;
    double blocked = 0;
    double wrong = 0;
};

/// Counts the example's pixels in a range of view depths, pixel by pixel. Bands use P in double,
/// this function uses float32; no pixel lies so near an edge that they differ.
Counts counts_between(double lower_m, double upper_m)
{
    const analysis::Comparison& comparison = example().comparison;
    const scene::Camera& camera = comparison.view.camera;
    Counts counts;
    for (std::size_t i = 0; i < example().points.pixel_count(); ++i) {
        const scene::PixelClass truth = comparison.truth.pixel_class[i];
        const double depth_m =
            glm::dot(camera.forward, scene::Vec3d{example().points[i]} - camera.eye);
        if (!scene::is_scored(truth) || depth_m < lower_m || depth_m >= upper_m) {
            continue;
        }
        const bool is_lit = truth == scene::PixelClass::lit;
        counts.lit += is_lit ? 1 : 0;
        counts.blocked += is_lit ? 0 : 1;
        counts.wrong += scene::is_lit(comparison.lookup.samples[i].verdict) == is_lit ? 0 : 1;
    }
    return counts;
}

TEST(ViewDepthCsv, CountsThePixelsOfEachBand)
{
    constexpr std::size_t bands = 5;
    const CsvTable table = parse_csv(view_depth_csv(example().comparison, bands));
    ASSERT_EQ(table.rows.size(), bands);
    double scored = 0;
    for (std::size_t i = 0; i < bands; ++i) {
        const auto& row = table.rows[i];
        const Counts counts = counts_between(i == 0 ? 0 : number(row, "lower_m"),
                                             i + 1 == bands ? 1e9 : number(row, "upper_m"));
        EXPECT_EQ(number(row, "lit"), counts.lit);
        EXPECT_EQ(number(row, "blocked"), counts.blocked);
        EXPECT_EQ(number(row, "false_shadow") + number(row, "false_lit"), counts.wrong);
        scored += counts.lit + counts.blocked;
    }
    EXPECT_EQ(scored, static_cast<double>(example().comparison.metrics.pixels.scored()));
}

TEST(ViewDepthCsv, HasBandsSideBySideByEqualFactors)
{
    const CsvTable table = parse_csv(view_depth_csv(example().comparison, 6));
    ASSERT_EQ(table.rows.size(), 6U);
    const double factor = number(table.rows[0], "upper_m") / number(table.rows[0], "lower_m");
    EXPECT_GT(factor, 1);
    for (std::size_t i = 1; i < 6; ++i) {
        EXPECT_EQ(table.rows[i].at("lower_m"), table.rows[i - 1].at("upper_m"));
        // A power and a product, rounded once each, on both sides.
        EXPECT_NEAR(number(table.rows[i], "upper_m") / number(table.rows[i], "lower_m"), factor,
                    8 * 0x1p-52 * factor);
    }
}

TEST(ViewDepthCsv, SaysTheJobAndOfOneMapTheTexelsWithoutSlices)
{
    const analysis::Comparison& comparison = example().comparison;
    const CsvTable table = parse_csv(view_depth_csv(comparison, 3));
    const auto texel_m = static_cast<float>(
        comparison.view.first_map().texel_width_m(1, comparison.job.shadow_map.resolution_texels));
    for (const auto& row : table.rows) {
        EXPECT_EQ(row.at("scene.file"), "models/example.obj");
        EXPECT_EQ(row.at("shadow_map.depth_format"), "d24");
        EXPECT_EQ(row.at("shadow_map.resolution"), "48");
        EXPECT_EQ(row.at("camera.eye"), "[2.5, 3.2, 5.5]");
        EXPECT_EQ(row.at("slice_edges_m"), "");
        EXPECT_EQ(row.at("slice_texels_m"), "");
        for (const char* const quantile : {"min", "median", "p95", "max"}) {
            EXPECT_EQ(static_cast<float>(number(row, std::string{"texel_m."} + quantile)), texel_m);
        }
    }
}

} // namespace
} // namespace gnomon::store
