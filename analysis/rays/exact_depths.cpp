#include "analysis/rays/exact_depths.hpp"

#include "analysis/bias/kept_terms.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <algorithm>
#include <vector>

namespace gnomon::analysis {

namespace {

constexpr std::uint8_t is_known = 1;
constexpr std::uint8_t is_wanted = 2;

/// Appends the texels of a map that are wanted and not known yet, in squares of 4 × 4, which are
/// fastest to trace.
void append_unknown(const scene::Image<std::uint8_t>& states, int map,
                    std::vector<scene::Texel>& texels)
{
    const int side = states.size().width_px;
    for (int y = 0; y < side; y += 4) {
        for (int x = 0; x < side; x += 4) {
            for (int i = 0; i < 16; ++i) {
                const scene::Texel texel{x + i % 4, y + i / 4, map};
                if (texel.x < side && texel.y < side && at_texel(states, texel) == is_wanted) {
                    texels.push_back(texel);
                }
            }
        }
    }
}

std::vector<scene::Texel> unknown_texels(const scene::Image<std::uint8_t>& states)
{
    std::vector<scene::Texel> texels;
    for (int map = 0; map < states.size().height_px / states.size().width_px; ++map) {
        append_unknown(states, map, texels);
    }
    return texels;
}

/// Moves the depths of a light's maps by the polygon offset.
void add_offsets(const MapOffsets& offsets, scene::Image<float>& depths)
{
    const int side = depths.size().width_px;
    for_each_run(depths.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            const int row = static_cast<int>(i) / side;
            const int map = row / side;
            const scene::Texel texel{static_cast<int>(i) % side, (map + 1) * side - 1 - row, map};
            const double depth{depths[i]};
            depths[i] = static_cast<float>(depth + offsets.at(texel, depth));
        }
    });
}

/// The depths of the pixels' P′.
scene::Image<float> kept_receivers(const CauseInputs& inputs, std::span<const std::size_t> pixels,
                                   const scene::MapIndices& maps)
{
    scene::Image<float> receivers{inputs.truth.pixel_class.size()};
    const auto depths = inputs.light.receiver_depths(pixels, maps, &inputs.terms->lookup.moved);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        receivers[pixels[i]] = depths[i];
    }
    return receivers;
}

} // namespace

KeptDepths::KeptDepths(const renderers::ExactDepths& depths, const CauseInputs& inputs)
    : map_{depths.map},
      samples_{depths.samples.begin(), depths.samples.end()}
{
    if (inputs.terms->offsets) {
        add_offsets(*inputs.terms->offsets, map_);
        for (scene::Image<float>& sample : samples_) {
            add_offsets(*inputs.terms->offsets, sample);
        }
    }
    std::vector<std::size_t> pixels;
    std::vector<std::size_t> with_next;
    scene::MapIndices next_maps = inputs.job.maps;
    for (std::size_t i = 0; i < inputs.truth.pixel_class.pixel_count(); ++i) {
        if (scene::is_lit(inputs.truth.pixel_class[i])) {
            pixels.push_back(i);
            if (inputs.job.next_at(i)) {
                with_next.push_back(i);
                ++next_maps[i];
            }
        }
    }
    receivers_ = kept_receivers(inputs, pixels, inputs.job.maps);
    if (!inputs.job.next_texels.empty()) {
        next_receivers_ = kept_receivers(inputs, with_next, next_maps);
    }
}

ExactDepthCache::ExactDepthCache(scene::ImageSize maps, scene::ImageSize image)
    : maps_{maps},
      receivers_{image}
{
}

renderers::ExactDepths ExactDepthCache::of(const CauseInputs& inputs,
                                           std::span<const scene::Vec2d> places, int layers)
{
    Traced& traced = traced_at(places, layers);
    want_texels(inputs, traced.knows_texel);
    trace(inputs.light, traced);
    if (!knows_receivers_) {
        find_receivers(inputs);
        find_next_receivers(inputs);
    }
    const bool has_samples = traced.depths.size() > 1;
    return {traced.depths.front(), receivers_, next_receivers_,
            has_samples ? std::span<const scene::Image<float>>{traced.depths}
                        : std::span<const scene::Image<float>>{}};
}

ExactDepthCache::Traced& ExactDepthCache::traced_at(std::span<const scene::Vec2d> places,
                                                    int layers)
{
    const auto known = std::ranges::find_if(traced_, [&](const Traced& traced) {
        return traced.layers == layers && std::ranges::equal(traced.places, places);
    });
    if (known != traced_.end()) {
        return *known;
    }
    return traced_.emplace_back(
        Traced{{places.begin(), places.end()},
               layers,
               std::vector<scene::Image<float>>(places.size() * static_cast<std::size_t>(layers),
                                                scene::Image<float>{maps_, 1.0F}),
               scene::Image<std::uint8_t>{maps_}});
}

void ExactDepthCache::want_texels(const CauseInputs& inputs, scene::Image<std::uint8_t>& texels)
{
    if (inputs.rule.traits.reads == methods::Reads::whole_map) {
        for (std::size_t i = 0; i < texels.pixel_count(); ++i) {
            texels[i] |= is_wanted;
        }
        return;
    }
    const Footprint footprint = inputs.footprint();
    const auto& classes = inputs.truth.pixel_class;
    const int last = inputs.resolution_texels - 1;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        const auto want = [&](const Tap& tap) {
            // Beyond the map's edge, a prefilter reads the nearest texel on the map.
            const int x = std::clamp(tap.texel.x, 0, last);
            const int y = std::clamp(tap.texel.y, 0, last);
            at_texel(texels, {x, y, tap.texel.map}) |= is_wanted;
        };
        for (const scene::LookupLayers* layers : {&inputs.unbiased, &inputs.of_lit()}) {
            footprint.visit_taps(layers->at(i), want);
            if (const auto next = layers->next_at(i)) {
                footprint.visit_taps(*next, want);
            }
        }
    }
}

void ExactDepthCache::trace(const renderers::LightQueries& light, Traced& traced)
{
    const std::vector<scene::Texel> texels = unknown_texels(traced.knows_texel);
    const auto keep = [&](std::size_t image, const std::vector<float>& depths) {
        for (std::size_t i = 0; i < texels.size(); ++i) {
            at_texel(traced.depths[image], texels[i]) = depths[i];
        }
    };
    for (std::size_t place = 0; place < traced.places.size(); ++place) {
        keep(place, light.texel_depths(texels, traced.places[place]));
    }
    if (traced.layers > 1) {
        keep(1, light.second_depths(texels));
    }
    for (const scene::Texel& texel : texels) {
        at_texel(traced.knows_texel, texel) |= is_known;
    }
}

void ExactDepthCache::find_receivers(const CauseInputs& inputs)
{
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < receivers_.pixel_count(); ++i) {
        if (scene::is_scored(inputs.truth.pixel_class[i])) {
            pixels.push_back(i);
        }
    }
    const std::vector<float> depths =
        inputs.light.receiver_depths(pixels, inputs.unbiased.maps, nullptr);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        receivers_[pixels[i]] = depths[i];
    }
    knows_receivers_ = true;
}

void ExactDepthCache::find_next_receivers(const CauseInputs& inputs)
{
    if (inputs.unbiased.next_texels.empty()) {
        return;
    }
    std::vector<std::size_t> pixels;
    scene::MapIndices maps = inputs.unbiased.maps;
    for (std::size_t i = 0; i < receivers_.pixel_count(); ++i) {
        if (scene::is_scored(inputs.truth.pixel_class[i]) && inputs.unbiased.next_at(i)) {
            pixels.push_back(i);
            ++maps[i];
        }
    }
    next_receivers_ = scene::Image<float>{receivers_.size()};
    const std::vector<float> depths = inputs.light.receiver_depths(pixels, maps, nullptr);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        next_receivers_[pixels[i]] = depths[i];
    }
}

} // namespace gnomon::analysis
