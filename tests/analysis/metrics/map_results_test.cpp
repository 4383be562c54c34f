// Checks errors by map at many biases from one lookup, against those of each bias's own verdicts.

#include "analysis/metrics/map_results.hpp"

#include "analysis/lookup/critical_bias.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::PixelClass;

/// One lookup in three maps, with classes and causes of its pixels.
struct MapSubject {
    static constexpr scene::ImageSize size{97, 31};

    scene::Truth truth{scene::Image<PixelClass>{size}, {}, {}, {}};
    scene::LookupLayers lookup{scene::Image<scene::LookupSample>{size},
                               scene::Image<scene::Vec2f>{size}};
    PixelCauses causes{scene::Image<PixelCause>{size}, {}};
    LookupRule rule;

    explicit MapSubject(unsigned seed)
    {
        std::mt19937 random{seed};
        std::uniform_real_distribution<float> depth{0, 1};
        constexpr std::array<PixelClass, 3> kinds{PixelClass::lit, PixelClass::blocked,
                                                  PixelClass::background};
        constexpr std::array<Cause, 3> reasons{Cause::none, Cause::resolution, Cause::coverage};
        lookup.maps = scene::MapIndices{size};
        for (std::size_t i = 0; i < truth.pixel_class.pixel_count(); ++i) {
            truth.pixel_class[i] = kinds.at(random() % 3);
            lookup.samples[i] = {depth(random), depth(random), 0, 0};
            lookup.maps[i] = static_cast<std::uint8_t>(random() % 3);
            const Cause reason = reasons.at(random() % 3);
            const float exact = random() % 2 == 0 ? depth(random) - 0.5F : scene::infinity;
            causes.pixels[i] = {reason, reason, random() % 2 == 0, exact};
        }
    }
};

TEST(MapRows, AreTheErrorsByMapOfEachBias)
{
    MapSubject subject{11};
    const auto critical = critical_biases(subject.lookup, subject.rule);
    const BiasRowInputs inputs{subject.truth.pixel_class, subject.lookup, critical, subject.causes,
                               subject.rule};
    const std::vector<float> biases{-2, -0.3F, 0, 0.01F, 0.2F, 3};
    const auto rows = count_map_errors(subject.lookup.maps, 3, inputs, biases);
    ASSERT_EQ(rows.size(), biases.size());
    for (std::size_t i = 0; i < biases.size(); ++i) {
        const CauseLayers causes = classify_errors(inputs, biases[i]);
        set_verdicts(subject.lookup, critical, biases[i]);
        const auto expected =
            errors_by_map({subject.truth, subject.lookup, subject.lookup.maps, 3, causes, 1});
        ASSERT_EQ(rows[i].size(), 3U);
        for (std::size_t map = 0; map < 3; ++map) {
            EXPECT_EQ(rows[i][map].counts, expected[map].counts) << biases[i] << ", " << map;
            EXPECT_EQ(rows[i][map].causes.by_cause, expected[map].causes.by_cause);
            EXPECT_EQ(rows[i][map].causes.by_label, expected[map].causes.by_label);
        }
    }
}

TEST(MapRows, OfALightWithOneMapAreNone)
{
    const MapSubject subject{12};
    const auto critical = critical_biases(subject.lookup, subject.rule);
    const BiasRowInputs inputs{subject.truth.pixel_class, subject.lookup, critical, subject.causes,
                               subject.rule};
    for (const auto& row : count_map_errors({}, 1, inputs, std::vector<float>{0, 1})) {
        EXPECT_TRUE(row.empty());
    }
}

TEST(MapRows, RejectImagesOfOtherSizes)
{
    const MapSubject subject{13};
    const auto critical = critical_biases(subject.lookup, subject.rule);
    const BiasRowInputs inputs{subject.truth.pixel_class, subject.lookup, critical, subject.causes,
                               subject.rule};
    EXPECT_THROW(
        (void)count_map_errors(scene::MapIndices{{2, 2}}, 3, inputs, std::vector<float>{0}),
        std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
