#include "compared.hpp"

#include "methods_job.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

/// If the biases follow the texel, a finer map has fewer errors.
namespace gnomon::tests {
namespace {

TEST(Columns, ErrorFallsMonotonicallyAsTheMapGrows)
{
    GNOMON_REQUIRE_GL();
    const auto at = [](int resolution, double constant, double slope) {
        return tests::builtin_job("columns",
                                  {{"shadow_map.resolution", fmt::format("{}", resolution)},
                                   {"shadow_map.depth_format", "d32f"},
                                   {"lookup.filter", "nearest"},
                                   {"bias.constant", fmt::format("{}", constant)},
                                   {"bias.slope", fmt::format("{}", slope)}})
            .job;
    };
    const Compared compared{at(256, 0, 0)};
    double last = 1;
    for (int resolution = 256; resolution <= 8192; resolution *= 2) {
        const scene::View view =
            resolve_view(at(resolution, 0, 0), compared.file().scene, compared.file().defaults);
        // A texel's width in depth units. The biases are half of it, and 0.71 of it times tan θ.
        const double texel =
            view.first_map().texel_width_m(1.0, resolution) / view.first_map().range_m();
        const auto result = compared.without_diagnosis(at(resolution, 0.5 * texel, 0.71 * texel));
        const double error_rate = result.metrics.error_rate.value();
        EXPECT_LT(error_rate, last) << resolution;
        RecordProperty(fmt::format("error_rate_{}", resolution), fmt::format("{}", error_rate));
        last = error_rate;
    }
    EXPECT_LT(last, 0.005);
}

} // namespace
} // namespace gnomon::tests
