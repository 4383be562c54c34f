#include "analysis/lookup/deciding_samples.hpp"

#include "analysis/lookup/stored_taps.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/job_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

constexpr float no_depth = std::numeric_limits<float>::quiet_NaN();

/// The median of the taps' depths; NaN where the border mode decides.
float deciding_depth(const StoredTaps& taps, const scene::LookupSample& sample,
                     const scene::MapPoint& at, bool reversed)
{
    std::array<float, methods::most_taps> depths; // filled as far as it is read
    const std::span<float> read = taps.gather(sample, at, depths);
    if (read.empty()) {
        return no_depth;
    }
    // The farther a tap is, the smaller a bias lights it: of an even number there are two middles.
    const std::size_t rank = deciding_rank(read.size());
    float* const middle = read.data() + (reversed ? rank : read.size() - 1 - rank);
    std::nth_element(read.data(), middle, read.data() + read.size());
    return std::isinf(*middle) ? no_depth : *middle;
}

void require_taps(const scene::LookupLayers& lookup, const scene::Image<scene::Vec2f>& texels,
                  const scene::Image<float>& map_depths)
{
    const scene::ImageSize map = map_depths.size();
    if (texels.size() != lookup.samples.size()) {
        throw std::invalid_argument(
            fmt::format("deciding_samples: texels: {}x{}, but the lookup is {}x{}",
                        texels.size().width_px, texels.size().height_px,
                        lookup.samples.size().width_px, lookup.samples.size().height_px));
    }
    if (map_depths.empty() || map.height_px % map.width_px != 0) {
        throw std::invalid_argument(
            fmt::format("deciding_samples: map_depths: {}x{}, but a shadow map is square",
                        map.width_px, map.height_px));
    }
}

} // namespace

scene::LookupLayers deciding_samples(scene::LookupLayers lookup, const scene::LookupLayers& where,
                                     const scene::Image<float>& map_depths, const LookupRule& rule)
{
    const methods::LookupTraits& promised = rule.traits;
    if (!promised.has_formula()) {
        throw std::invalid_argument(
            "deciding_samples: rule: its lookups have no formula, and no deciding tap");
    }
    if (promised.returns_deciding_depth()) {
        return lookup;
    }
    require_taps(lookup, where.texels, map_depths);
    const StoredTaps taps{map_depths, rule};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            scene::LookupSample& sample = lookup.samples[i];
            sample.map_depth = deciding_depth(taps, sample, where.at(i), rule.reversed);
        }
    });
    return lookup;
}

bool can_derive_unbiased(const scene::Job& job, const scene::View& view)
{
    return methods::traits(job).has_formula() && !methods::moves_lookups(job, view);
}

} // namespace gnomon::analysis
