#pragma once

#include "analysis/causes/find_causes.hpp"
#include "analysis/limits/bias_rows.hpp"

#include "fake_light.hpp"
#include "lookup_case.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// One pixel and a map of 8×8 texels, looked up at the centre of texel (4, 4) with r = ½.
struct OnePixel {
    static constexpr int resolution = 8;

    scene::LookupSettings settings{scene::Filter::nearest, scene::Outside::lit};
    bool reversed = false;
    scene::Truth truth;
    scene::LookupLayers lookup;   ///< with the job's bias
    scene::LookupLayers unbiased; ///< without
    scene::Image<float> map_depths{{resolution, resolution}, 1.0F};
    FakeLight light;
    /// The bias terms besides constant and slope; V2 keeps them if they are known.
    std::optional<KeptTerms> terms = {};

    explicit OnePixel(scene::PixelClass pixel_class)
    {
        truth.pixel_class = scene::Image<scene::PixelClass>{{1, 1}, pixel_class};
        unbiased.samples = scene::Image<scene::LookupSample>{{1, 1}, {0.5F, 0.5F, 0, 1}};
        unbiased.texels = scene::Image<scene::Vec2f>{{1, 1}, {4.5F, 4.5F}};
        lookup = unbiased;
        light.pixel_depths[0] = 0.5;
        light.places[0] = unbiased.texels[0];
    }

    /// Sets P′ − P, and the depth by which the receiver is nearer to the light.
    OnePixel& moved(const scene::Vec4f& by)
    {
        terms.emplace();
        terms->lookup.moved = scene::Image<scene::Vec4f>{{1, 1}, by};
        return *this;
    }
    /// Sets the verdicts of the job's lookup and of the unbiased one.
    OnePixel& verdicts(float v0, float v1)
    {
        lookup.samples[0].verdict = v0;
        unbiased.samples[0].verdict = v1;
        unbiased.samples[0].map_depth = v1 < 0.5F ? 0.25F : 0.5F;
        lookup.samples[0].map_depth = unbiased.samples[0].map_depth;
        return *this;
    }
    OnePixel& sees(int x, int y, double depth, double light_distance_m = 1,
                   std::uint32_t triangle = 7)
    {
        light.hits[{x, y}] = {triangle, depth, light_distance_m};
        return *this;
    }

    /// Sets the depth that GL stored in a texel.
    OnePixel& stores(int x, int y, float depth)
    {
        map_depths(x, resolution - 1 - y) = depth;
        return *this;
    }
    /// All taps of a 3 × 3 lookup see and store this depth.
    OnePixel& sees_everywhere(float depth, std::uint32_t triangle = 7)
    {
        for (int i = 0; i < 9; ++i) {
            sees(3 + i % 3, 3 + i / 3, double{depth}, 1, triangle);
            stores(3 + i % 3, 3 + i / 3, depth);
        }
        return *this;
    }

    [[nodiscard]] LookupRule rule(float slope = 0) const
    {
        return rule_of(settings.filter, settings.outside, reversed, slope);
    }
    [[nodiscard]] PixelCauses causes() const
    {
        const bool has_filter = settings.filter != scene::Filter::nearest;
        PixelCauses found{scene::Image<PixelCause>{{1, 1}},
                          scene::Image<FilterCause>{scene::ImageSize{has_filter ? 1 : 0, 1}}};
        CauseInputs inputs{rule(), resolution, truth, lookup, unbiased, map_depths, light};
        inputs.terms = terms ? &*terms : nullptr;
        find_lit_causes(inputs, found);
        const bool is_blocked = truth.pixel_class[0] == scene::PixelClass::blocked;
        find_blocked_causes(
            inputs,
            scene::Image<std::uint8_t>{{1, 1}, is_blocked ? std::uint8_t{1} : std::uint8_t{0}},
            found);
        return found;
    }
    [[nodiscard]] PixelCause found() const { return causes().pixels[0]; }
    [[nodiscard]] CauseLayers classified(const scene::Bias& bias = {}) const
    {
        const PixelCauses pixels = causes();
        const scene::Image<float> verdicts = criticals_of_verdicts(lookup);
        const LookupRule rule_of_job = rule(bias.slope);
        const TapCriticals taps{lookup, map_depths, rule_of_job};
        return classify_errors({truth.pixel_class, lookup, verdicts, pixels, rule_of_job,
                                settings.filter == scene::Filter::nearest ? nullptr : &taps, true},
                               bias.constant);
    }
};

inline void expect_cause(const CauseLayers& layers, Cause cause, Label label)
{
    EXPECT_EQ(cause_names[static_cast<std::size_t>(layers.cause[0])],
              cause_names[static_cast<std::size_t>(cause)]);
    EXPECT_EQ(label_names[static_cast<std::size_t>(layers.label[0])],
              label_names[static_cast<std::size_t>(label)]);
    EXPECT_EQ(layers.counts.of(cause), 1U);
    EXPECT_EQ(layers.counts.of(label), 1U);
}

} // namespace gnomon::analysis
