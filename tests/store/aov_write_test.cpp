#include "store/exr/aov.hpp"

#include "analysis/depth/depth_mapping.hpp"
#include "example_comparison.hpp"
#include "exr_layers.hpp"
#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace gnomon::store {
namespace {

using testing::UnorderedElementsAre;

/// The content of an EXR file.
class ReadLayers {
public:
    explicit ReadLayers(const std::filesystem::path& path) : layers_{read_exr(path)} {}

    [[nodiscard]] const ExrLayers& all() const { return layers_; }
    [[nodiscard]] std::size_t pixel_count() const
    {
        return layers_.channels.begin()->second.size();
    }
    [[nodiscard]] std::uint32_t bits(const char* channel, std::size_t pixel) const
    {
        return layers_.channels.at(channel)[pixel];
    }
    [[nodiscard]] float value(const char* channel, std::size_t pixel) const
    {
        return layers_.value(channel, pixel);
    }
    [[nodiscard]] std::string text(const std::string& attribute) const
    {
        const auto found = layers_.texts.find("gnomon:" + attribute);
        return found == layers_.texts.end() ? "" : found->second;
    }
    [[nodiscard]] std::vector<double> numbers(const std::string& attribute) const
    {
        std::istringstream stream{text(attribute)};
        std::vector<double> result;
        for (std::string word; stream >> word;) {
            result.push_back(std::strtod(word.c_str(), nullptr));
        }
        return result;
    }

private:
    ExrLayers layers_;
};

std::vector<std::string> names_of(const ReadLayers& layers)
{
    std::vector<std::string> names;
    for (const auto& [name, bits] : layers.all().channels) {
        names.push_back(name);
    }
    return names;
}

ReadLayers written_and_read(const Example& source)
{
    const TemporaryFolder folder;
    write_aov(folder / "layers.exr", source.comparison, source.points);
    return ReadLayers{folder / "layers.exr"};
}

TEST(WriteAov, NamesItsChannels)
{
    const ReadLayers layers = written_and_read(example());
    EXPECT_THAT(names_of(layers),
                UnorderedElementsAre("truth", "class", "verdict", "prim", "P.X", "P.Y", "P.Z",
                                     "N.X", "N.Y", "N.Z", "object", "witness", "receiver_depth",
                                     "map_depth", "tan_theta"));
    for (const char* name : {"class", "prim", "object", "witness"}) {
        EXPECT_FALSE(layers.all().is_float.at(name)) << name;
    }
    for (const char* name : {"truth", "verdict", "P.X", "receiver_depth", "map_depth"}) {
        EXPECT_TRUE(layers.all().is_float.at(name)) << name;
    }
    EXPECT_EQ(layers.all().compression, "zip");
}

TEST(WriteAov, KeepsEveryBit)
{
    const ReadLayers layers = written_and_read(example());
    const analysis::Comparison& comparison = example().comparison;
    ASSERT_EQ(layers.pixel_count(), comparison.truth.pixel_class.pixel_count());
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    for (std::size_t i = 0; i < layers.pixel_count(); ++i) {
        const scene::LookupSample& sample = comparison.lookup.samples[i];
        ASSERT_EQ(layers.bits("class", i),
                  static_cast<std::uint32_t>(comparison.truth.pixel_class[i]));
        ASSERT_EQ(layers.bits("prim", i), comparison.receivers.triangle[i]);
        ASSERT_EQ(layers.bits("witness", i), comparison.truth.witness[i]);
        ASSERT_EQ(layers.bits("verdict", i), bits(sample.verdict));
        ASSERT_EQ(layers.bits("receiver_depth", i), bits(sample.receiver_depth));
        ASSERT_EQ(layers.bits("map_depth", i), bits(sample.map_depth));
        ASSERT_EQ(layers.bits("P.X", i), bits(example().points[i].x));
        ASSERT_EQ(layers.bits("P.Y", i), bits(example().points[i].y));
        ASSERT_EQ(layers.bits("P.Z", i), bits(example().points[i].z));
    }
}

TEST(WriteAov, KeepsNanAndTheLargestIndices)
{
    Example changed;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    changed.comparison.lookup.samples[0].map_depth = nan;
    changed.comparison.receivers.triangle[0] = 0xFFFFFFFF;
    changed.comparison.receivers.triangle[1] = 0xFFFFFFFE; // a float would round this one
    const ReadLayers layers = written_and_read(changed);
    EXPECT_EQ(layers.bits("map_depth", 0), std::bit_cast<std::uint32_t>(nan));
    EXPECT_EQ(layers.bits("prim", 0), 0xFFFFFFFF);
    EXPECT_EQ(layers.bits("prim", 1), 0xFFFFFFFE);
}

TEST(WriteAov, GivesTruthOnlyToScoredPixels)
{
    const ReadLayers layers = written_and_read(example());
    for (std::size_t i = 0; i < layers.pixel_count(); ++i) {
        const scene::PixelClass pixel_class = example().comparison.truth.pixel_class[i];
        const float expected = pixel_class == scene::PixelClass::lit       ? 1.0F
                               : pixel_class == scene::PixelClass::blocked ? 0.0F
                                                                           : -1.0F;
        ASSERT_EQ(layers.value("truth", i), expected) << "pixel " << i;
    }
}

TEST(WriteAov, WritesExactInputsThatReadBackToTheSameBits)
{
    const ReadLayers layers = written_and_read(example());
    const scene::View& view = example().comparison.view;
    const auto components = [](const scene::Vec3d& v) {
        return std::vector<double>{v.x, v.y, v.z};
    };
    EXPECT_EQ(layers.numbers("eye"), components(view.camera.eye));
    EXPECT_EQ(layers.numbers("forward"), components(view.camera.forward));
    EXPECT_EQ(layers.numbers("right"), components(view.camera.right));
    EXPECT_EQ(layers.numbers("up"), components(view.camera.up));
    EXPECT_EQ(layers.numbers("half_height"), std::vector<double>{view.camera.half_height});
    EXPECT_EQ(layers.numbers("light_direction"), components(view.light.direction));
    const std::vector<double> matrix = layers.numbers("light_clip_from_world");
    ASSERT_EQ(matrix.size(), 16U);
    for (std::size_t i = 0; i < 16; ++i) {
        const auto row = static_cast<int>(i / 4);
        const auto column = static_cast<int>(i % 4);
        EXPECT_EQ(matrix[i],
                  static_cast<double>(view.first_map().light_clip_from_world[column][row]));
    }
}

TEST(WriteAov, CarriesTheJobAsJson)
{
    const ReadLayers layers = written_and_read(example());
    const auto job = nlohmann::json::parse(layers.text("job"));
    EXPECT_EQ(job["shadow_map.resolution"], 48);
    EXPECT_EQ(layers.text("scene_hash"), example().comparison.scene.hash);
    EXPECT_EQ(layers.text("truth_method"), "exact");
}

TEST(WriteAov, WritesTheSameBytesAgain)
{
    const TemporaryFolder folder;
    write_aov(folder / "a.exr", example().comparison, example().points);
    write_aov(folder / "b.exr", example().comparison, example().points);
    EXPECT_EQ(read_text(folder / "a.exr"), read_text(folder / "b.exr"));
    const ReadLayers layers{folder / "a.exr"};
    EXPECT_FALSE(layers.all().texts.contains("capDate"));
}

TEST(WriteAov, ReportsAFullDiskAndAMissingFolder)
{
    const TemporaryFolder folder;
    for (const std::filesystem::path& path :
         {std::filesystem::path{"/dev/full"}, folder / "none/layers.exr"}) {
        EXPECT_THROW(write_aov(path, example().comparison, example().points),
                     scene::EnvironmentError)
            << path;
    }
    EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(WriteAov, RejectsPointsOfAnotherSize)
{
    const TemporaryFolder folder;
    EXPECT_THROW(write_aov(folder / "layers.exr", example().comparison,
                           scene::Image<scene::Vec3f>{scene::ImageSize{1, 1}}),
                 std::invalid_argument);
}

/// Depths from 0 to 1 over the example's map.
scene::Image<float> ramp()
{
    const int side = example().comparison.job.shadow_map.resolution_texels;
    scene::Image<float> depths{scene::ImageSize{side, side}, 0.0F};
    for (std::size_t i = 0; i < depths.pixel_count(); ++i) {
        depths[i] = static_cast<float>(i) / static_cast<float>(depths.pixel_count() - 1);
    }
    return depths;
}

TEST(WriteDepthMap, HoldsDepthsAndTheDistancesThatTheyStandFor)
{
    const TemporaryFolder folder;
    const scene::Image<float> depths = ramp();
    for (const bool is_reversed : {false, true}) {
        Example changed;
        changed.comparison.view.maps.front().reversed = is_reversed;
        write_depth_map(folder / "map.exr", changed.comparison, depths);
        const ReadLayers map{folder / "map.exr"};
        EXPECT_THAT(names_of(map), UnorderedElementsAre("depth", "light_distance_m"));
        const analysis::DepthMapping mapping{changed.comparison.view.first_map().depth_range()};
        const std::size_t last = depths.pixel_count() - 1;
        const std::size_t farthest = is_reversed ? 0 : last;
        for (std::size_t i = 0; i <= last; ++i) {
            ASSERT_EQ(map.value("depth", i), depths[i]);
            if (i != farthest) {
                ASSERT_EQ(map.value("light_distance_m", i),
                          static_cast<float>(mapping.light_distance_m(double{depths[i]})));
            }
        }
        EXPECT_TRUE(std::isnan(map.value("light_distance_m", farthest)));
        EXPECT_EQ(map.value("light_distance_m", last - farthest),
                  static_cast<float>(mapping.near_m()));
        EXPECT_EQ(map.text("scene"), changed.comparison.scene.name);
    }
}

TEST(WriteDepthMap, HoldsAPartForEachOfSeveralMaps)
{
    const TemporaryFolder folder;
    Example changed;
    auto& maps = changed.comparison.view.maps;
    maps.assign(3, maps.front());
    maps[2].far_m *= 2;
    const int side = changed.comparison.job.shadow_map.resolution_texels;
    scene::Image<float> depths{scene::maps_image_size(side, 3), 0.25F};
    const std::size_t texels = ramp().pixel_count();
    std::fill(depths.data() + texels, depths.data() + 2 * texels, 0.5F);
    std::fill(depths.data() + 2 * texels, depths.data() + 3 * texels, 0.75F);
    write_depth_map(folder / "map.exr", changed.comparison, depths);
    const std::vector<ExrLayers> parts = read_exr_parts(folder / "map.exr");
    ASSERT_EQ(parts.size(), 3U);
    for (std::size_t map = 0; map < parts.size(); ++map) {
        const ExrLayers& part = parts[map];
        EXPECT_EQ(part.name, std::to_string(map));
        EXPECT_EQ(part.width_px, side);
        EXPECT_EQ(part.height_px, side);
        const float depth = 0.25F * static_cast<float>(map + 1);
        const analysis::DepthMapping mapping{maps[map].depth_range()};
        for (std::size_t i = 0; i < texels; ++i) {
            ASSERT_EQ(part.value("depth", i), depth);
            ASSERT_EQ(part.value("light_distance_m", i),
                      static_cast<float>(mapping.light_distance_m(double{depth})));
        }
    }
    EXPECT_EQ(folder.entry_count(), 1U); // and nothing beside it
    EXPECT_FALSE(std::filesystem::exists("layers.exr"));
}

TEST(WriteDepthMap, RefusesDepthsOfAnotherSize)
{
    const TemporaryFolder folder;
    EXPECT_THROW(write_depth_map(folder / "map.exr", example().comparison,
                                 scene::Image<float>{scene::ImageSize{2, 2}, 0.0F}),
                 std::invalid_argument);
    EXPECT_EQ(folder.entry_count(), 0U);
}

} // namespace
} // namespace gnomon::store
