#include "compared.hpp"
#include "expectations.hpp"
#include "methods_job.hpp"
#include "placed_scene.hpp"

#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <tuple>

/// An independent checker certifies the truth of every scene as it is, far from the origin, large
/// and small, and every difference between GL's and the exact receivers is explained.
namespace gnomon::tests {
namespace {

using scene::ClassReason;
using scene::PixelClass;

const Placement as_it_is{"as it is"};
const Placement far_away{"100 diagonals away", 1, 100};
const Placement thousandfold{"1000 times as large", 1e3};
const Placement thousandth{"1000 times as small", 1e-3};

using Subject = std::tuple<std::string, Placement>;

std::filesystem::path shared_file(const std::string& name)
{
    const char* const folder = std::getenv("GNOMON_SHARED_SCENES");
    return std::filesystem::path{folder == nullptr ? "" : folder} / name;
}

bool is_shared(const std::string& name)
{
    return name.ends_with(".obj");
}

/// The job of a built-in scene, or of a mesh in the shared folder.
scene::Job placed_job(const std::string& name, const std::vector<scene::Override>& keys)
{
    return is_shared(name) ? scene::read_job(shared_file(name), keys, {}, methods::key_table()).job
                           : tests::builtin_job(name, keys).job;
}

/// Expects no unexplained pixel, and no more excluded ones than the definition of truth allows.
void expect_explained(const Subject& subject, const analysis::ClassCounts& pixels)
{
    const auto& [name, placement] = subject;
    EXPECT_EQ(pixels.of(ClassReason::mismatch), 0U);
    EXPECT_LE(1e4 * static_cast<double>(pixels.of(PixelClass::indeterminate)),
              static_cast<double>(pixels.scored()));
    const double unmatched = static_cast<double>(pixels.of(PixelClass::unmatched)) /
                             static_cast<double>(pixels.surface());
    // Far away GL's float32 transforms move edges by tenths of a pixel: docs/truth.md has the
    // rates.
    if (placement.diagonals == 0) {
        const bool has_tiny_triangles =
            name == "sphere-field" || name == "bunny.obj" || name == "nefertiti.obj";
        EXPECT_LT(unmatched, has_tiny_triangles ? 0.03 : 0.01);
    }
    std::cout << fmt::format("{}, {}: unmatched {:.4f} %: snap {}, tie {}, mismatch {}; "
                             "indeterminate {} of {} scored\n",
                             name, placement.name, 100 * unmatched, pixels.of(ClassReason::snap),
                             pixels.of(ClassReason::tie), pixels.of(ClassReason::mismatch),
                             pixels.of(PixelClass::indeterminate), pixels.scored());
}

void expect_sound(const Subject& subject, const std::vector<scene::Override>& keys,
                  const std::optional<std::uint64_t>& sample)
{
    const auto& [name, placement] = subject;
    const scene::Job job = placed_job(name, keys);
    const Placed placed = place(job, scene::load_scene(job.scene), placement);
    const Compared compared{placed.file};
    const auto result = compared(placed.job);
    expect_explained(subject, result.metrics.pixels);
    expect_certified(result, sample);
}

class PlacedScene : public testing::TestWithParam<Subject> {
protected:
    void SetUp() override
    {
        GNOMON_REQUIRE_GL();
        const std::string& name = std::get<0>(GetParam());
        if (is_shared(name) && !std::filesystem::exists(shared_file(name))) {
            GTEST_SKIP() << name << " is not in the folder GNOMON_SHARED_SCENES";
        }
    }
};

TEST_P(PlacedScene, IsCertifiedAndExplained)
{
    expect_sound(GetParam(), {{"image.width", "320"}, {"image.height", "180"}}, 200);
}

class LongPlacedScene : public PlacedScene {};

TEST_P(LongPlacedScene, IsCertifiedAndExplained)
{
    expect_sound(GetParam(), {}, std::nullopt);
}

std::vector<std::string> every_scene()
{
    std::vector<std::string> names{"suzanne.obj", "bunny.obj", "nefertiti.obj"};
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        names.push_back(builtin.name);
    }
    return names;
}

/// "sphere-field, 100 diagonals away" as an identifier.
std::string identifier(const testing::TestParamInfo<Subject>& subject)
{
    std::string text = std::get<0>(subject.param) + "_" + std::get<1>(subject.param).name;
    std::ranges::replace_if(
        text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return text;
}

const auto placements = testing::Values(as_it_is, far_away, thousandfold, thousandth);

INSTANTIATE_TEST_SUITE_P(Some, PlacedScene,
                         testing::Combine(testing::Values("wall", "sphere-plane", "suzanne.obj"),
                                          placements),
                         identifier);
INSTANTIATE_TEST_SUITE_P(Every, LongPlacedScene,
                         testing::Combine(testing::ValuesIn(every_scene()), placements),
                         identifier);

} // namespace
} // namespace gnomon::tests
