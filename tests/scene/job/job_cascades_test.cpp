// The keys of cascades: requirements, exclusions and replacements.

#include "job_fixture.hpp"

#include "scene/job/sweep/sweep.hpp"
#include "scene/settings/job.hpp"

#include <gmock/gmock.h>

namespace gnomon::scene::test {
namespace {

using testing::HasSubstr;

const std::string in_cascades =
    "[scene]\nbuiltin = \"terrain\"\n[shadow_map]\nlayout = \"cascades\"\n";

/// Settings and the expected error message.
struct Refused {
    std::string more; ///< of `[shadow_map]`
    std::vector<Override> overrides;
    std::string message;
};

TEST(Cascades, AreFourThatAreSplitPractically)
{
    const Job job = job_of(in_cascades).job;
    EXPECT_EQ(map_layout(job), MapLayout::cascades);
    EXPECT_EQ(map_count(job), 4U);
    EXPECT_EQ(lookup_position(job), LookupPosition::pixel);
    EXPECT_FALSE(mixes_maps(job));
    const CascadeSettings& settings = job.shadow_map.cascades;
    EXPECT_EQ(settings.split, CascadeSplit::practical);
    EXPECT_EQ(settings.split_lambda, 0.5);
    EXPECT_EQ(settings.fit, CascadeFit::tight);
    EXPECT_EQ(settings.select, CascadeSelect::view_depth);
    EXPECT_FALSE(settings.near_m || settings.far_m);
}

TEST(Cascades, RefuseWhatTheyCannotDoInOneLine)
{
    const std::vector<Refused> all{
        {"cascades = 1\n", {}, "shadow_map.cascades = 1: must be an integer from 2 to 8"},
        {"cascades = 9\n", {}, "shadow_map.cascades = 9: must be an integer from 2 to 8"},
        {"split_lambda = 2\n", {}, "shadow_map.split_lambda = 2: must be a number from 0 to 1"},
        {"blend = 1\n", {}, "shadow_map.blend = 1: must be a number from 0 to 0.999"},
        {"cascade_near = 0\n",
         {},
         "shadow_map.cascade_near = 0: must be \"auto\" or a number from"},
        {"split = \"uniform\"\nsplit_lambda = 0.5\n",
         {},
         "shadow_map.split_lambda = 0.5: only for shadow_map.split = \"practical\""},
        {"cascade_near = 40\ncascade_far = 10\n",
         {},
         "shadow_map.cascade_near = 40: must be less than shadow_map.cascade_far"},
        {"cascade_fit = \"stabilised\"\ncascade_far = 10\n",
         {},
         "needs shadow_map.cascade_near and shadow_map.cascade_far in metres, so that the slices "
         "do not change with the view; shadow_map.cascade_near is missing"},
        {"cascade_fit = \"stabilised\"\ncascade_near = 1\ncascade_far = \"auto\"\n",
         {},
         "shadow_map.cascade_far is missing"},
        {"cascade_fit = \"stabilised\"\ncascade_near = 1\ncascade_far = 9\nresolution = 1000\n",
         {},
         "shadow_map.resolution = 1000: must be a power of two"},
        {"cascade_fit = \"stabilised\"\ncascade_near = 1\ncascade_far = 9\nresolution = 1\n",
         {},
         "shadow_map.resolution = 1: must be a power of two, at least 2"},
        {"blend = 0.1\nselect = \"containing\"\n",
         {},
         "shadow_map.blend = 0.1: cascades are blended by view depth"},
        {"fit = \"camera\"\n", {}, "with cascades it is \"scene\", for each map has a slice"},
        {"half_extent = 3\n", {}, "only for shadow_map.fit = \"fixed\""},
        {"content = \"distance\"\n[light]\ndirection = [0, -1, 0]\n",
         {},
         "a directional light is nowhere, and has no distances"},
        {"[lookup]\nposition = \"vertex\"\n", {}, "with cascades it is \"pixel\""},
        {"[light]\ntype = \"spot\"\nposition = [0, 3, 0]\ntarget = [0, 0, 1]\n",
         {},
         "only directional lights have cascades"},
        {"[light]\ntype = \"point\"\nposition = [0, 3, 0]\n",
         {},
         "a point light's maps are the faces of a cube"}};
    for (const Refused& refused : all) {
        const std::string message = refusal(in_cascades + refused.more, refused.overrides);
        EXPECT_THAT(message, HasSubstr(refused.message)) << refused.more;
        EXPECT_EQ(message.find('\n'), message.npos) << message;
    }
}

TEST(Cascades, AreAskedForByTheirLayoutAlone)
{
    for (const std::string key :
         {"cascades = 3", "split = \"uniform\"", "split_lambda = 0.5", "cascade_near = 1",
          "cascade_far = 9", "cascade_fit = \"tight\"", "select = \"containing\"", "blend = 0.1"}) {
        const std::string job = "[scene]\nbuiltin = \"terrain\"\n[shadow_map]\n" + key + "\n";
        EXPECT_THAT(refusal(job), HasSubstr("only for shadow_map.layout = \"cascades\"; set that "
                                            "too, or remove this key"))
            << key;
    }
}

TEST(Cascades, AreLeftBehindByAnotherLayoutOrLight)
{
    const std::string job = in_cascades + "cascades = 3\nblend = 0.1\n";
    const Job single = job_of(job, {{"shadow_map.layout", "single"}}).job;
    EXPECT_EQ(map_count(single), 1U);
    EXPECT_EQ(lookup_position(single), LookupPosition::vertex);
    const Job point =
        job_of(job,
               {{"light.type", "point"}, {"light.position", "[0, 9, 0]"}, {"bias.constant", "0"}})
            .job;
    EXPECT_EQ(map_layout(point), MapLayout::cube);
    const Job turned = job_of(job, {{"light.type", "directional"}}).job;
    EXPECT_EQ(map_count(turned), 3U);
}

TEST(Cascades, LeaveBehindWhatOneMapFits)
{
    const std::string job = "[scene]\nbuiltin = \"terrain\"\n[shadow_map]\nfit = \"fixed\"\n"
                            "half_extent = 3\n[lookup]\nposition = \"vertex\"\n";
    EXPECT_EQ(map_count(job_of(job, {{"shadow_map.layout", "cascades"}}).job), 4U);
}

TEST(Cascades, TakeTheirLambdaAlongTheirSplits)
{
    const std::string job = in_cascades + "split_lambda = 0.8\n";
    for (const char* split : {"uniform", "logarithmic"}) {
        const Job other = job_of(job, {{"shadow_map.split", split}}).job;
        EXPECT_NE(other.shadow_map.cascades.split, CascadeSplit::practical);
    }
}

} // namespace
} // namespace gnomon::scene::test
