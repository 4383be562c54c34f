#include "analysis/tune/method_space.hpp"
#include "analysis/tune/method_tune.hpp"
#include "fake_methods.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::DepthFormat;
using scene::JobValue;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

scene::Job job_of_method(const std::string& method, int resolution_texels)
{
    scene::Job job = job_of_sheet();
    job.method.name = method;
    job.shadow_map.resolution_texels = resolution_texels;
    job.shadow_map.depth_format = {DepthFormat::Kind::d24, 24};
    return job;
}

constexpr std::uint64_t four_mebibytes = 4U << 20U;

TEST(LargestResolution, IsTheSideOfAsManyBytes)
{
    EXPECT_EQ(largest_resolution(job_of_method("depth", 256), {four_mebibytes, 4096}), 1024);
    EXPECT_EQ(largest_resolution(job_of_method("depth", 256), {four_mebibytes - 1, 4096}), 1008);
    scene::Job halves = job_of_method("depth", 256);
    halves.shadow_map.depth_format = {DepthFormat::Kind::d16, 16};
    // 1448² · 2 bytes fit, and 1440 is the multiple of 16.
    EXPECT_EQ(largest_resolution(halves, {four_mebibytes, 4096}), 1440);
    // A depth and two textures of two floats: 20 bytes a texel, 457.9² texels.
    EXPECT_EQ(largest_resolution(job_of_method("vsm", 256), {four_mebibytes, 4096}), 448);
}

TEST(LargestResolution, IsBoundedByTheLargestMap)
{
    EXPECT_EQ(largest_resolution(job_of_method("depth", 256), {four_mebibytes, 512}), 512);
    EXPECT_EQ(largest_resolution(job_of_method("depth", 256), {four_mebibytes, 8}), 0);
}

TEST(LargestResolution, TakesTheJobsOwnWhereThatIsLarger)
{
    EXPECT_EQ(largest_resolution(job_of_method("depth", 1000), {1000 * 1000 * 4, 4096}), 1000);
    EXPECT_EQ(largest_resolution(job_of_method("depth", 1001), {1000 * 1000 * 4, 4096}), 992);
}

TEST(LargestResolution, IsAPowerOfTwoForStabilisedCascades)
{
    scene::Job job = job_of_method("depth", 256);
    job.shadow_map.layout = scene::MapLayout::cascades;
    job.shadow_map.cascades.count = 4;
    EXPECT_EQ(largest_resolution(job, {12U << 20U, 4096}), 880); // 886.8² · 4 · 4 bytes
    job.shadow_map.cascades.fit = scene::CascadeFit::stabilised;
    EXPECT_EQ(largest_resolution(job, {12U << 20U, 4096}), 512);
}

TEST(LargestResolution, LeavesAMethodWithoutAMapAsItIs)
{
    EXPECT_EQ(largest_resolution(job_of_method("shadow_volumes", 300), {1, 4096}), 300);
}

scene::Key key_of_lengths(scene::TriedUnit unit)
{
    return scene::added_key({}, scene::RealDomain{0, 10}, 0.0,
                            {.values = {0.5, 3.0}, .unit = unit});
}

TEST(TriedValues, BeginWithTheDefaultAndCountWhatTheRowSays)
{
    using scene::TriedUnit;
    EXPECT_THAT(tried_values(key_of_lengths(TriedUnit::of_key), 8, 2),
                ElementsAre(JobValue{0.0}, JobValue{0.5}, JobValue{3.0}));
    EXPECT_THAT(tried_values(key_of_lengths(TriedUnit::scene_diagonals), 8, 2),
                ElementsAre(JobValue{0.0}, JobValue{4.0}, JobValue{24.0}));
    // With two digits: 0.61725 and 3.7035.
    EXPECT_THAT(tried_values(key_of_lengths(TriedUnit::texel_widths), 8, 1.2345),
                ElementsAre(JobValue{0.0}, JobValue{0.62}, JobValue{3.7}));
}

/// A job accepts every value that a key's row names.
TEST(TriedValues, AreAllowedByTheirKeys)
{
    std::size_t values = 0;
    for (const methods::Method& method : methods::methods()) {
        for (const scene::Key& key : methods::key_table()->rows()) {
            for (const JobValue& value : key.tried.values) {
                if (key.is_of(method.name)) {
                    EXPECT_NO_THROW(
                        (void)scene::builtin_job("wall",
                                                 {{"method.name", std::string{method.name}},
                                                  {key.name, scene::to_toml(value)}},
                                                 methods::key_table()))
                        << key.name;
                    EXPECT_NE(value, key.default_value) << key.name << ": is tried anyway";
                    ++values;
                }
            }
        }
    }
    EXPECT_GT(values, 100U);
}

/// The keys that differ between two settings.
std::vector<std::string> keys_between(const scene::Job& job, const TunedSetting& a,
                                      const TunedSetting& b)
{
    return changed_keys(tuned_job(job, a), tuned_job(job, b));
}

TEST(MethodSpace, FollowsFromTheKeysOfTheMethod)
{
    const FakeWorld world;
    const scene::Job job = job_of_sheet();
    const CheckedViews views = world.views(job);
    const MethodSpace space{job, "shadow_volumes", world.file, views, {1, 4096}};
    ASSERT_EQ(space.axis_count(), 2U);
    const TunedSetting start = space.starts().front();
    const auto extrusions = space.along(0, start);
    ASSERT_THAT(extrusions, SizeIs(1));
    EXPECT_THAT(keys_between(job, start, extrusions[0]),
                ElementsAre("method.extrusion = \"triangle\""));
    const auto casters = space.along(1, extrusions[0]);
    ASSERT_THAT(casters, SizeIs(1));
    EXPECT_THAT(
        keys_between(job, start, casters[0]),
        ElementsAre("method.extrusion = \"triangle\"", "method.casters = \"facing_light\""));
    EXPECT_EQ(start.cost.map_bytes, 0U);
}

TEST(MethodSpace, KeepsMapsWithinTheirBytes)
{
    const FakeWorld world;
    const scene::Job job = job_of_sheet();
    const CheckedViews views = world.views(job);
    for (const methods::Method& method : methods::methods()) {
        const MethodSpace space{
            job, std::string{method.name}, world.file, views, {four_mebibytes, 4096}};
        const TunedSetting start = space.starts().front();
        std::size_t most = 1;
        for (std::size_t axis = 0; axis < space.axis_count(); ++axis) {
            const auto others = space.along(axis, start);
            for (const TunedSetting& other : others) {
                EXPECT_LE(other.cost.map_bytes, four_mebibytes) << method.name;
            }
            most += others.size();
        }
        EXPECT_LE(most, space.most_settings(1)) << method.name;
        EXPECT_GT(most, 1U) << method.name;
    }
}

TEST(MethodSpace, BeginsWithWhatTheMethodHasOfTheJob)
{
    const FakeWorld world;
    scene::Job job = job_of_method("vsm", 512);
    job.method.values["method.kernel_width"] = std::int64_t{9};
    job.method.values["method.min_variance"] = 1e-5;
    job.method.values["bias.slope_kernels"] = 2.0;
    job.bias.normal_texels = 3;
    const CheckedViews views = world.views(job);
    const TunedSetting esm =
        MethodSpace{job, "esm", world.file, views, {four_mebibytes, 4096}}.starts().front();
    EXPECT_THAT(esm.method->values,
                ElementsAre(std::pair{"bias.slope_kernels", JobValue{2.0}},
                            std::pair{"method.kernel_width", JobValue{std::int64_t{9}}}));
    EXPECT_EQ(esm.normal_texels, 3);
    const TunedSetting volumes =
        MethodSpace{job, "shadow_volumes", world.file, views, {four_mebibytes, 4096}}
            .starts()
            .front();
    EXPECT_THAT(volumes.method->values, IsEmpty());
    EXPECT_EQ(volumes.normal_texels, 0);
}

} // namespace
} // namespace gnomon::analysis
