#include "analysis/comparison/view_depth_errors.hpp"

#include "analysis/pixels/pixel_runs.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "methods/job_method.hpp"

#include <glm/geometric.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::analysis {

namespace {

/// Values of the scored pixels, else NaN.
struct ViewDepthValues {
    scene::Image<float> view_depth_m;
    scene::Image<float> texel_m;
};

ViewDepthValues values_of(const Comparison& comparison)
{
    const scene::View& view = comparison.view;
    const auto& classes = comparison.truth.pixel_class;
    const ReceiverGeometry geometry{*comparison.triangles, view, comparison.receivers.triangle};
    const scene::Image<float> nothing{classes.size(), std::numeric_limits<float>::quiet_NaN()};
    ViewDepthValues values{nothing, nothing};
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            if (!scene::is_scored(classes[i])) {
                continue;
            }
            const scene::Vec3d point = geometry.point(i);
            const auto map = static_cast<std::size_t>(scene::map_of(comparison.lookup.maps, i));
            const scene::LightFrustum& read = view.maps.at(map);
            values.view_depth_m[i] =
                static_cast<float>(glm::dot(view.camera.forward, point - view.camera.eye));
            values.texel_m[i] = static_cast<float>(read.texel_width_m(
                read.light_distance_m(point), comparison.job.shadow_map.resolution_texels));
        }
    });
    return values;
}

std::optional<Quantiles> quantiles_of(const scene::Image<float>& values,
                                      std::span<const std::uint32_t> pixels)
{
    std::vector<float> of_band;
    of_band.reserve(pixels.size());
    for (const std::uint32_t i : pixels) {
        of_band.push_back(values[i]);
    }
    return find_quantiles(std::move(of_band));
}

} // namespace

std::vector<ViewDepthErrors> errors_by_view_depth(const Comparison& comparison, int bands)
{
    const auto& classes = comparison.truth.pixel_class;
    const ViewDepthValues values = values_of(comparison);
    const Binning binning = bin_by_view_depth(classes, values.view_depth_m, bands);
    const auto counts = count_by_bin(binning, comparison.truth, comparison.lookup,
                                     methods::traits(comparison.job).equal_taps());
    std::vector<ViewDepthErrors> errors;
    for (std::size_t band = 0; band < counts.size(); ++band) {
        errors.push_back({binning.edge(static_cast<int>(band)),
                          binning.edge(static_cast<int>(band) + 1), counts[band],
                          quantiles_of(values.texel_m, binning.pixels_of(band))});
    }
    return errors;
}

} // namespace gnomon::analysis
