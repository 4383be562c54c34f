#include "methods/depth/depth_map.hpp"
#include "methods/list.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace gnomon::methods {
namespace {

using scene::Filter;

scene::Job job_with(Filter filter)
{
    scene::Job job;
    job.lookup.filter = filter;
    return job;
}

TEST(Methods, AreListedByName)
{
    ASSERT_EQ(methods().size(), 1U);
    EXPECT_EQ(methods()[0].name, "depth");
    EXPECT_EQ(find_method("depth"), methods().data());
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

TEST(Methods, HaveTheKeysOfTheirTablesAndNoOthers)
{
    std::set<std::string> keys;
    for (const scene::JobKey& key : keys_of(methods()[0])) {
        keys.insert(key.name);
    }
    for (const scene::JobKey& key : scene::job_keys()) {
        const bool is_own = key.name.starts_with("shadow_map.") ||
                            key.name.starts_with("lookup.") || key.name.starts_with("bias.");
        EXPECT_EQ(keys.contains(key.name), is_own) << key.name;
    }
    Method none = methods()[0];
    none.key_tables = {};
    EXPECT_TRUE(keys_of(none).empty());
}

TEST(Promises, OfAJobAreThoseOfItsFilter)
{
    const Rises exactly{Rise::exactly, 0};
    const Promises one{Verdict::binary, Compares::each_tap, exactly, Curve::by_formula, true};
    const Promises mean{Verdict::binary, Compares::mean_depth, exactly, Curve::by_formula, true};
    const Promises driver{Verdict::fraction, Compares::each_tap, exactly, Curve::by_bisection,
                          true};
    const Promises share{Verdict::fraction, Compares::each_tap, exactly, Curve::by_formula, true};
    EXPECT_EQ(promises(scene::Job{}), one);
    EXPECT_EQ(promises(job_with(Filter::nearest)), one);
    EXPECT_EQ(promises(job_with(Filter::linear)), mean);
    EXPECT_EQ(promises(job_with(Filter::hardware)), driver);
    for (const Filter filter : {Filter::pcf3, Filter::pcf5, Filter::pcf7, Filter::pcf9}) {
        EXPECT_EQ(promises(job_with(filter)), share) << scene::filter_name(filter);
    }
}

TEST(Promises, WithAFilterAreThoseOfAJobThatNamesIt)
{
    for (const FilterPromises& filter : methods()[0].filters) {
        EXPECT_EQ(promises_with(methods()[0], filter.filter), promises(job_with(filter.filter)));
    }
}

TEST(MapBytes, AreTwoOrFourATexel)
{
    scene::ShadowMapSettings map;
    map.resolution_texels = 512;
    for (const auto& [format, bytes] :
         {std::pair{"d16", 2U}, std::pair{"d24", 4U}, std::pair{"d32", 4U}, std::pair{"d32f", 4U},
          std::pair{"u8", 2U}, std::pair{"u16", 2U}, std::pair{"u17", 4U}, std::pair{"u24", 4U}}) {
        map.depth_format = scene::depth_format_from_name(format).value();
        EXPECT_EQ(map_bytes(map), 512U * 512 * bytes) << format;
        EXPECT_EQ(methods()[0].map_bytes(map), map_bytes(map)) << format;
    }
}

TEST(MapBytes, OfTheSmallestAndTheLargestMap)
{
    scene::ShadowMapSettings map;
    map.resolution_texels = 1;
    EXPECT_EQ(map_bytes(map), 4U);
    map.resolution_texels = 16384; // 2³⁰ bytes
    EXPECT_EQ(map_bytes(map), std::uint64_t{1} << 30U);
}

TEST(TapCount, IsTheTexelsOfTheFootprint)
{
    EXPECT_EQ(tap_count(Filter::nearest), 1);
    EXPECT_EQ(tap_count(Filter::hardware), 4);
    EXPECT_EQ(tap_count(Filter::pcf9), 81);
}

} // namespace
} // namespace gnomon::methods
