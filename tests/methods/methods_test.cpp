#include "methods/depth/depth_map.hpp"
#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::methods {
namespace {

using scene::Filter;

scene::Job job_with(Filter filter)
{
    scene::Job job;
    job.keys = methods::key_table();
    job.lookup.filter = filter;
    return job;
}

TEST(Methods, AreListedByName)
{
    ASSERT_EQ(methods().size(), 10U);
    EXPECT_EQ(methods()[0].name, "depth");
    EXPECT_EQ(methods()[1].name, "vsm");
    EXPECT_EQ(find_method("depth"), &methods()[0]);
    EXPECT_EQ(find_method("vsm"), &methods()[1]);
    EXPECT_EQ(find_method("moments"), nullptr);
    EXPECT_EQ(find_method(""), nullptr);
}

TEST(Methods, DescribeThemselves)
{
    for (const Method& method : methods()) {
        SCOPED_TRACE(method.name);
        EXPECT_FALSE(method.sentence.empty());
        EXPECT_FALSE(method.sources.empty());
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path{GNOMON_ROOT} / method.page));
        EXPECT_FALSE(keys_of(method).empty());
    }
}

/// The tables that a method shares with others.
const std::set<std::string>& tables_of(std::string_view method)
{
    static const std::map<std::string, std::set<std::string>, std::less<>> tables{
        {"depth", {"shadow_map", "lookup", "bias"}},
        {"vsm", {"shadow_map", "lookup", "bias"}},
        {"esm", {"shadow_map", "lookup", "bias"}},
        {"evsm", {"shadow_map", "lookup", "bias"}},
        {"msm", {"shadow_map", "lookup", "bias"}},
        {"primitive_id", {"shadow_map", "lookup"}},
        {"shadow_volumes", {}},
        {"pcf", {"shadow_map", "lookup", "bias"}},
        {"pcss", {"shadow_map", "lookup", "bias"}},
        {"second_layer", {"shadow_map", "lookup", "bias"}}};
    return tables.find(method)->second;
}

TEST(Methods, HaveTheKeysOfTheirTablesAndTheirOwnAndNoOthers)
{
    for (const Method& method : methods()) {
        SCOPED_TRACE(method.name);
        const std::set<std::string>& tables = tables_of(method.name);
        std::set<std::string> expected;
        for (const scene::Key& key : methods::key_table()->rows()) {
            const std::string table = key.name.substr(0, key.name.find('.'));
            const bool is_shared = table == "shadow_map" || table == "lookup" || table == "bias";
            if (is_shared && tables.contains(table) &&
                (key.name != "lookup.filter" || method.name == "depth")) {
                expected.insert(key.name);
            }
        }
        for (const scene::Key& own : method.keys) {
            EXPECT_TRUE(own.name.starts_with("method.")) << own.name;
            EXPECT_TRUE(expected.insert(own.name).second) << own.name;
        }
        std::set<std::string> keys;
        for (const scene::Key& key : keys_of(method)) {
            EXPECT_TRUE(keys.insert(key.name).second) << key.name;
        }
        EXPECT_EQ(keys, expected);
    }
    Method none = methods()[0];
    none.key_tables = {};
    none.bias_terms = {};
    EXPECT_TRUE(keys_of(none).empty());
}

TEST(LookupTraits, OfAJobAreThoseOfItsFilter)
{
    const LookupTraits one{.verdict = Verdict::binary,
                           .compares = Compares::each_tap,
                           .monotonicity = {Monotone::exactly, 0},
                           .curve = Curve::by_formula,
                           .width_texels = 1,
                           .weights = Weights::equal,
                           .kernel = {},
                           .map_bytes = 4U << 20U, // 1024² texels of d32f
                           .has_map = true};
    LookupTraits mean = one;
    mean.compares = Compares::mean_depth;
    mean.width_texels = 2;
    mean.weights = Weights::bilinear;
    LookupTraits driver = one;
    driver.verdict = Verdict::fraction;
    driver.curve = Curve::by_bisection;
    driver.width_texels = 2;
    driver.weights = Weights::bilinear_of_gl;
    EXPECT_EQ(traits(scene::Job{}), one);
    EXPECT_EQ(traits(job_with(Filter::nearest)), one);
    EXPECT_EQ(traits(job_with(Filter::linear)), mean);
    EXPECT_EQ(traits(job_with(Filter::hardware)), driver);
    LookupTraits share = one;
    share.verdict = Verdict::fraction;
    for (const Filter filter : {Filter::pcf3, Filter::pcf5, Filter::pcf7, Filter::pcf9}) {
        share.width_texels += 2;
        EXPECT_EQ(traits(job_with(filter)), share) << scene::filter_name(filter);
    }
}

TEST(LookupTraits, WithAFilterAreThoseOfAJobThatNamesIt)
{
    for (const FilterChoice& filter : methods()[0].filters) {
        EXPECT_EQ(traits_with(methods()[0], filter.filter), traits(job_with(filter.filter)));
    }
}

TEST(MapBytes, AreTwoOrFourATexel)
{
    scene::Job job;
    job.keys = methods::key_table();
    scene::ShadowMapSettings& map = job.shadow_map;
    map.resolution_texels = 512;
    for (const auto& [format, bytes] :
         {std::pair{"d16", 2U}, std::pair{"d24", 4U}, std::pair{"d32", 4U}, std::pair{"d32f", 4U},
          std::pair{"r32f", 4U}, std::pair{"r16f", 2U}, std::pair{"rgba8", 4U}, std::pair{"u8", 2U},
          std::pair{"u16", 2U}, std::pair{"u17", 4U}, std::pair{"u24", 4U}}) {
        map.depth_format = scene::depth_format_from_name(format).value();
        EXPECT_EQ(map_bytes(job), 512U * 512 * bytes) << format;
        EXPECT_EQ(traits(job).map_bytes, map_bytes(job)) << format;
    }
}

TEST(MapBytes, OfTheSmallestAndTheLargestMap)
{
    scene::Job job;
    job.keys = methods::key_table();
    job.shadow_map.resolution_texels = 1;
    EXPECT_EQ(map_bytes(job), 4U);
    job.shadow_map.resolution_texels = 16384; // 2³⁰ bytes
    EXPECT_EQ(map_bytes(job), std::uint64_t{1} << 30U);
}

TEST(MapBytes, OfAPointLightAreThoseOfSixMaps)
{
    scene::Job job;
    job.keys = methods::key_table();
    job.light.emplace().type = scene::LightType::point;
    job.shadow_map.resolution_texels = 512;
    EXPECT_EQ(map_bytes(job), 6U * 512 * 512 * 4);
}

TEST(TapCount, IsTheTexelsOfTheFootprint)
{
    EXPECT_EQ(filter_traits(Filter::nearest).tap_count(), 1U);
    EXPECT_EQ(filter_traits(Filter::hardware).tap_count(), 4U);
    EXPECT_EQ(filter_traits(Filter::pcf9).tap_count(), 81U);
}

} // namespace
} // namespace gnomon::methods
