#include "analysis/lookup/taps.hpp"

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

using scene::MapPoint;

StoredTaps::StoredTaps(const scene::Image<float>& map_depths, const LookupRule& rule)
    : map_depths_{map_depths},
      rule_{rule},
      footprint_{rule.traits, rule.edge(), map_depths.size().width_px}
{
}

std::span<float> StoredTaps::gather(const scene::LookupSample& sample, const MapPoint& at,
                                    std::span<float> out) const
{
    if (rule_.outside != scene::Outside::clamp && border_decides_all(sample, at)) {
        return {};
    }
    float* next = out.data();
    if (const auto first = footprint_.first_if_on_map(at)) {
        const int width = footprint_.width_texels();
        for (int y = 0; y < width; ++y) {
            const scene::Texel row{first->x, first->y + y, first->map};
            next = std::copy_n(&at_texel(map_depths_, row), width, next);
        }
    } else {
        footprint_.visit_taps(at, [&](const Tap& tap) {
            *next++ = tap.is_inside ? at_texel(map_depths_, tap.texel) : rule_.outside_depth();
        });
    }
    return {out.data(), next};
}

/// A receiver behind a spot is beyond far by its r. If r rounds to the far plane, its missing
/// centre tap inside the map tells.
bool StoredTaps::border_decides_all(const scene::LookupSample& sample, const MapPoint& at) const
{
    return rule_.is_beyond_far(sample.receiver_depth) ||
           (std::isnan(sample.map_depth) && footprint_.is_inside(at));
}

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
    // A smaller bias lights farther taps first. An even number of taps has two medians.
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
    const methods::LookupTraits& traits = rule.traits;
    if (!traits.has_formula()) {
        throw std::invalid_argument(
            "deciding_samples: rule: its lookups have no formula, hence no deciding tap");
    }
    if (traits.returns_deciding_depth()) {
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
