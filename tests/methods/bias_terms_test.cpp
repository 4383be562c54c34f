#include "methods/depth/bias_terms.hpp"

#include "scene/job/keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::methods {
namespace {

using scene::Stage;
using ::testing::ElementsAre;

/// "bias.constant [depth units]" of each key.
std::vector<std::string> keys_with_units(const BiasTerm& term)
{
    std::vector<std::string> texts;
    for (const scene::JobKey& key : keys_of(term)) {
        texts.push_back(key.name + " [" + key.unit + "]");
    }
    return texts;
}

TEST(BiasTerms, AreThoseOfTheList)
{
    const auto terms = bias_terms();
    ASSERT_EQ(terms.size(), 3U);
    EXPECT_EQ(terms[0].name, "constant");
    EXPECT_EQ(terms[0].place, BiasPlace::receiver_depth);
    EXPECT_THAT(keys_with_units(terms[0]),
                ElementsAre("bias.constant [depth units]", "bias.constant_m [m]"));
    EXPECT_EQ(terms[1].name, "slope");
    EXPECT_EQ(terms[1].place, BiasPlace::receiver_depth);
    EXPECT_THAT(keys_with_units(terms[1]),
                ElementsAre("bias.slope [depth units per unit of the tangent]"));
    EXPECT_EQ(terms[2].name, "normal offset");
    EXPECT_EQ(terms[2].place, BiasPlace::lookup_position);
    EXPECT_THAT(keys_with_units(terms[2]), ElementsAre("bias.normal_texels [texel widths]"));
}

/// The stage from which a term that acts there takes part.
Stage first_stage(BiasPlace place)
{
    switch (place) {
    case BiasPlace::map_drawn:
        return Stage::shadow_map;
    case BiasPlace::lookup_position:
    case BiasPlace::per_tap:
        return Stage::lookup;
    case BiasPlace::receiver_depth:
        return Stage::bias;
    }
    return Stage::scene;
}

TEST(BiasTerms, AreOfTheStageInWhichTheyAct)
{
    for (const BiasTerm& term : bias_terms()) {
        EXPECT_EQ(stages_of(term), scene::only(first_stage(term.place))) << term.name;
        for (const scene::JobKey& key : keys_of(term)) {
            EXPECT_EQ(key.stages, stages_of(term)) << key.name;
        }
    }
}

TEST(BiasTerms, SetEveryKeyOfTheirTableOnce)
{
    std::set<std::string> set;
    for (const BiasTerm& term : bias_terms()) {
        EXPECT_FALSE(term.sentence.empty()) << term.name;
        for (const scene::JobKey& key : keys_of(term)) {
            EXPECT_TRUE(set.insert(key.name).second) << key.name;
        }
    }
    for (const scene::JobKey& key : scene::job_keys()) {
        EXPECT_EQ(set.contains(key.name), key.name.starts_with("bias.")) << key.name;
    }
}

TEST(BiasTerms, RejectAKeyThatHasNoRow)
{
    constexpr std::array<std::string_view, 1> unknown{"bias.polygon"};
    const BiasTerm term{"polygon offset", unknown, BiasPlace::map_drawn, "none"};
    EXPECT_THROW((void)keys_of(term), std::invalid_argument);
    EXPECT_THROW((void)stages_of(term), std::invalid_argument);
}

} // namespace
} // namespace gnomon::methods
