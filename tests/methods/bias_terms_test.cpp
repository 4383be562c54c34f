#include "methods/depth/depth_map.hpp"
#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "methods/refusal.hpp"

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <span>
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
    for (const scene::Key& key : keys_of(term)) {
        texts.push_back(key.name + " [" + key.unit + "]");
    }
    return texts;
}

TEST(BiasTerms, AreRefusedWhereNoTapHasADepthOfItsOwn)
{
    for (const Method& method : methods()) {
        for (const BiasTerm& term : method.bias_terms) {
            const bool has_no_taps = term.name == "receiver plane" && method.name != "depth";
            const bool has_two_layers =
                term.place == BiasPlace::map_drawn && method.name == "second_layer";
            EXPECT_EQ(refuses(method, term), has_no_taps || has_two_layers)
                << method.name << ": " << term.name;
        }
    }
}

TEST(BiasTerms, AreThoseOfTheList)
{
    const auto terms = bias_terms();
    ASSERT_EQ(terms.size(), 9U);
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
    EXPECT_EQ(terms[3].place, BiasPlace::lookup_position);
    EXPECT_THAT(keys_with_units(terms[3]), ElementsAre("bias.normal_m [m]", "bias.normal_from []"));
    EXPECT_EQ(terms[4].place, BiasPlace::receiver_depth);
    EXPECT_THAT(keys_with_units(terms[4]), ElementsAre("bias.constant_texels [texel widths]"));
    EXPECT_EQ(terms[5].place, BiasPlace::map_drawn);
    EXPECT_THAT(keys_with_units(terms[5]),
                ElementsAre("bias.polygon_offset_factor []", "bias.polygon_offset_units [r]",
                            "bias.polygon_offset_clamp [depth units]"));
    EXPECT_THAT(keys_with_units(terms[6]), ElementsAre("bias.slope_kernels [kernels]"));
    EXPECT_THAT(keys_with_units(terms[7]), ElementsAre("bias.adaptive_m [m]"));
    EXPECT_EQ(terms[8].place, BiasPlace::per_tap);
    EXPECT_THAT(keys_with_units(terms[8]),
                ElementsAre("bias.receiver_plane []", "bias.receiver_plane_clamp [depth units]"));
}

TEST(BiasTerms, AreOfOneStageAndOfAPlaceWhereALookupActs)
{
    for (const BiasTerm& term : bias_terms()) {
        EXPECT_NO_THROW(check(term)) << term.name;
        for (const scene::Key& key : keys_of(term)) {
            EXPECT_EQ(key.stages, stages_of(term)) << key.name;
        }
        const bool is_of_formula = term.name == "constant" || term.name == "slope";
        EXPECT_EQ(is_of_curve(term), is_of_formula) << term.name;
    }
}

/// A view with every bias set to a nonzero value.
scene::View view_with_every_bias()
{
    scene::View view;
    view.maps.emplace_back();
    view.bias = {.constant = 1, .slope = 2, .normal_texels = 3, .added = {}};
    view.bias.added = {{"bias.normal_m", 4.0F},
                       {"bias.constant_texels", 1.0F},
                       {"bias.polygon_offset_factor", 5.0F},
                       {"bias.polygon_offset_units", 6.0F},
                       {"bias.polygon_offset_clamp", 0.5F},
                       {"bias.slope_kernels", 7.0F},
                       {"bias.adaptive_m", 8.0F},
                       {"bias.receiver_plane_clamp", 1.0F}};
    return view;
}

TEST(BiasTerms, DefineTheFunctionThatTheyName)
{
    scene::Job job;
    job.keys = methods::key_table();
    job.method.values["bias.receiver_plane"] = std::string{"analytic"};
    const scene::View view = view_with_every_bias();
    const auto active = active_biases(bias_terms(), job, view);
    ASSERT_EQ(active.size(), bias_terms().size() - 1) << "the polygon offset has no GLSL";
    for (const ActiveBias& bias : active) {
        const std::string start = std::string{" "} + std::string{bias.term->function} + "(Receiver";
        EXPECT_NE(bias.snippet.glsl.find(start), std::string_view::npos) << bias.term->name;
        ASSERT_EQ(bias.snippet.uniforms.size(), 1U) << bias.term->name;
        EXPECT_NE(bias.snippet.uniforms[0].values, std::vector{0.0F}) << bias.term->name;
    }
    EXPECT_TRUE(moves_lookups(active));
}

TEST(BiasTerms, OffsetTheMapByWhatTheKeysSay)
{
    EXPECT_EQ(bias_terms()[5].offset(view_with_every_bias()), (PolygonOffset{5, 6, 0.5F}));
    EXPECT_EQ(bias_terms()[5].offset(scene::View{}), std::nullopt) << "an unbiased map";
}

TEST(BiasTerms, OfTheCurveAloneActWithoutANormalOffset)
{
    const auto active = active_biases(bias_terms(), scene::Job{}, scene::View{});
    ASSERT_EQ(active.size(), 2U);
    EXPECT_EQ(active[0].term->name, "constant");
    EXPECT_EQ(active[1].term->name, "slope");
    EXPECT_FALSE(moves_lookups(active));
    EXPECT_FALSE(moves_lookups(std::span<const ActiveBias>{}));
}

TEST(BiasTerms, SetEveryKeyOfTheirTableOnce)
{
    std::set<std::string> set;
    for (const BiasTerm& term : bias_terms()) {
        EXPECT_FALSE(term.sentence.empty()) << term.name;
        for (const scene::Key& key : keys_of(term)) {
            EXPECT_TRUE(set.insert(key.name).second) << key.name;
        }
    }
    for (const scene::Key& key : methods::key_table()->rows()) {
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

/// The error of `check` for the term; may be empty.
std::string refusal(const BiasTerm& term)
{
    try {
        check(term);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return {};
}

std::vector<scene::Key> key_of_another_table()
{
    return {scene::added_key(scene::make_key("method.pull", "", "", scene::only(Stage::lookup)),
                             scene::RealDomain{.lower = 0, .upper = 1}, 0.0)};
}
std::vector<scene::Key> key_that_is_not_listed()
{
    return {scene::added_key(scene::make_key("bias.pull", "", "", scene::only(Stage::lookup)),
                             scene::RealDomain{.lower = 0, .upper = 1}, 0.0)};
}
std::vector<scene::Key> no_keys()
{
    return {};
}

TEST(BiasTerms, AreRefusedWhereNoLookupDoesAsTheySay)
{
    const BiasTerm slope = bias_terms()[1];
    const BiasTerm offset = bias_terms()[2];
    BiasTerm term = offset;
    term.place = BiasPlace::map_drawn;
    EXPECT_EQ(refusal(term), "bias term normal offset: the stage of its keys must be shadow map");
    term.place = BiasPlace::per_tap;
    EXPECT_EQ(refusal(term), "") << "of the stage lookup";
    term = bias_terms()[5];
    term.offset = nullptr;
    EXPECT_EQ(refusal(term), "bias term polygon offset: it has no offset");
    term = offset;
    term.place = BiasPlace::receiver_depth;
    EXPECT_EQ(refusal(term), "") << "of the stage lookup";
    term = slope;
    term.place = BiasPlace::lookup_position;
    EXPECT_EQ(refusal(term), "bias term slope: the stage of its keys must be lookup");
    term = slope;
    term.own_keys = no_keys;
    EXPECT_EQ(refusal(term), "bias term slope: the bias curve's formula has constant and slope "
                             "alone: its stage must be lookup");
}

TEST(BiasTerms, AreRefusedOfSeveralStages)
{
    constexpr std::array<std::string_view, 2> keys{"bias.slope", "bias.normal_texels"};
    BiasTerm term = bias_terms()[1];
    term.keys = keys;
    EXPECT_EQ(refusal(term), "bias term slope: the stage of its keys must be lookup");
}

TEST(BiasTerms, AreRefusedWithoutGlsl)
{
    BiasTerm term = bias_terms()[2];
    term.function = {};
    EXPECT_EQ(refusal(term), "bias term normal offset: it has no GLSL");
    term = bias_terms()[2];
    term.snippet = nullptr;
    EXPECT_EQ(refusal(term), "bias term normal offset: it has no GLSL");
}

TEST(BiasTerms, AreRefusedWhereTheCurveWouldVaryAnotherThanTheConstantBias)
{
    const std::array swapped{bias_terms()[1], bias_terms()[0]};
    const std::array without{bias_terms()[2], bias_terms()[1]};
    EXPECT_THROW(check(std::span<const BiasTerm>{swapped}), std::invalid_argument);
    EXPECT_THROW(check(std::span<const BiasTerm>{without}), std::invalid_argument);
    EXPECT_NO_THROW(check(bias_terms()));
    EXPECT_NO_THROW(check(bias_terms().subspan(2)));
}

TEST(BiasTerms, AreRefusedWithKeysOfAnotherTableOrNotListed)
{
    BiasTerm term = bias_terms()[2];
    term.own_keys = key_of_another_table;
    EXPECT_EQ(refusal(term), "bias term normal offset: its keys must be of [bias]");
    term.own_keys = key_that_is_not_listed;
    EXPECT_EQ(refusal(term), "bias term normal offset: its keys lack bias.pull");
}

} // namespace
} // namespace gnomon::methods
