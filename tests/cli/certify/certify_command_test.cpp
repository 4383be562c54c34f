#include "analysis/comparison/comparison.hpp"
#include "cli/commands.hpp"
#include "reference_rt/certificate/pixel.hpp"
#include "reference_rt/truth.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"
#include "store/exr/aov.hpp"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::cli {
namespace {

using scene::Image;
using scene::no_triangle;
using scene::PixelClass;
using testing::HasSubstr;

/// The built-in "wall" and its truth as an AOV. The truth comes from brute force, so neither GL nor
/// Embree is needed.
class WallAov {
public:
    WallAov()
        : job_{scene::builtin_job("wall", {{"image.width", "32"}, {"image.height", "24"}}).job},
          file_{scene::load_scene(job_.scene)}
    {
        comparison.job = job_;
        comparison.view = scene::resolve_view(job_, file_.scene, file_.defaults);
        comparison.scene = analysis::summarise_scene(job_.scene, file_.scene);
        comparison.triangles = &file_.scene;
        comparison.receivers.triangle = Image<std::uint32_t>{job_.image, no_triangle};
        comparison.lookup.samples = Image<scene::LookupSample>{job_.image};
        comparison.truth.pixel_class = Image<PixelClass>{job_.image};
        comparison.truth.reason = Image<scene::ClassReason>{job_.image};
        comparison.truth.witness = Image<std::uint32_t>{job_.image, no_triangle};
        const reference_rt::certificate::BruteForce brute_force{file_.scene, comparison.view};
        for (int y = 0; y < job_.image.height_px; ++y) {
            for (int x = 0; x < job_.image.width_px; ++x) {
                // Where GL sees nothing, the exact ray's hit is what GL should see.
                const std::uint32_t first = brute_force.decide(x, y, no_triangle).triangle;
                const auto finding = brute_force.decide(x, y, first);
                comparison.receivers.triangle(x, y) = first;
                comparison.truth.pixel_class(x, y) = finding.pixel_class;
                if (finding.pixel_class == PixelClass::blocked) {
                    comparison.truth.witness(x, y) = std::min(finding.triangle, finding.partner);
                }
            }
        }
        points = reference_rt::receiver_points(file_.scene, comparison.view,
                                               comparison.receivers.triangle);
        folder_ = std::filesystem::path{testing::TempDir()} / "gnomon_certify_command";
        std::filesystem::create_directories(folder_);
    }
    WallAov(const WallAov&) = delete;
    WallAov& operator=(const WallAov&) = delete;
    ~WallAov() { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::size_t find(PixelClass pixel_class) const
    {
        const auto& classes = comparison.truth.pixel_class;
        return static_cast<std::size_t>(std::find(classes.begin(), classes.end(), pixel_class) -
                                        classes.begin());
    }

    struct Result {
        int exit_code = 0;
        std::string output;
    };
    /// Runs `gnomon certify` on the comparison as it stands.
    [[nodiscard]] Result certify(const std::vector<std::string>& more = {},
                                 const std::string& builtin = "wall") const
    {
        const std::filesystem::path aov = folder_ / "wall.exr";
        store::write_aov(aov, comparison, points);
        CLI::App program;
        add_certify_command(program);
        // CLI11 reads the words in reverse.
        std::vector<std::string> words{"certify", aov.string(),     "--builtin", builtin,
                                       "--set",   "image.width=32", "--set",     "image.height=24"};
        words.insert(words.end(), more.begin(), more.end());
        std::ranges::reverse(words);
        Result result;
        testing::internal::CaptureStdout();
        try {
            program.parse(words);
        } catch (const CLI::RuntimeError& error) {
            result.exit_code = error.get_exit_code();
        } catch (...) {
            (void)testing::internal::GetCapturedStdout();
            throw;
        }
        result.output = testing::internal::GetCapturedStdout();
        return result;
    }

    analysis::Comparison comparison;
    Image<scene::Vec3f> points;

private:
    scene::Job job_;
    scene::SceneFile file_;
    std::filesystem::path folder_;
};

TEST(CertifyCommand, CertifiesAnHonestAov)
{
    const WallAov wall;
    const auto result = wall.certify();
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("certified, seed 0: all 751 surface pixels"));
    const auto sampled = wall.certify({"--sample", "100", "--seed", "9"});
    EXPECT_EQ(sampled.exit_code, 0);
    EXPECT_THAT(sampled.output,
                HasSubstr("certified, seed 9: 0 wrong of 100 drawn at random: at 95 % confidence "
                          "at most 3 % of the 751 surface pixels are wrong"));
}

TEST(CertifyCommand, PrintsJson)
{
    const auto result = WallAov{}.certify({"--json", "--sample", "100"});
    const auto json = nlohmann::json::parse(result.output);
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["certified"], true);
    EXPECT_EQ(json["sample"]["drawn"], 100);
    EXPECT_EQ(json["sample"]["error_rate_bound"], 0.03);
    EXPECT_EQ(json["witnesses"]["checked"], json["pixels"]["blocked"]);
    EXPECT_EQ(json["positions"]["checked"], json["sample"]["surface_pixels"]);
    EXPECT_EQ(json["sample"]["derived"]["background"], json["pixels"]["background"]);
    EXPECT_TRUE(json["refutations"].empty());
}

TEST(CertifyCommand, RefutesTamperedAovsWithExitCodeOne)
{
    using enum PixelClass;
    const auto expect_refuted = [](const WallAov& wall, const std::string& reason) {
        const auto result = wall.certify({"--json"});
        EXPECT_EQ(result.exit_code, 1);
        const auto json = nlohmann::json::parse(result.output);
        EXPECT_EQ(json["certified"], false);
        EXPECT_EQ(json["wrong"], 1);
        EXPECT_TRUE(json["sample"]["error_rate_bound"].is_null());
        EXPECT_THAT(json["refutations"].at(0)["reason"].get<std::string>(), HasSubstr(reason));
        EXPECT_THAT(wall.certify().output, HasSubstr("refuted: 1 wrong pixels\n  pixel ("));
    };
    WallAov flipped;
    flipped.comparison.truth.pixel_class[flipped.find(lit)] = attached;
    expect_refuted(flipped, "it is lit");
    WallAov unblocked;
    const std::size_t blocked_pixel = unblocked.find(blocked);
    unblocked.comparison.truth.pixel_class[blocked_pixel] = lit;
    unblocked.comparison.truth.witness[blocked_pixel] = no_triangle;
    expect_refuted(unblocked, "crosses the segment to the light (signs: edges ");
    WallAov replaced;
    replaced.comparison.truth.witness[replaced.find(blocked)] = 0;
    expect_refuted(replaced, "witness 0 ");
    WallAov moved;
    moved.points[moved.find(lit)].x += 0.01F;
    expect_refuted(moved, "its P.X is ");
    WallAov erased;
    const std::size_t seen = erased.find(lit);
    erased.comparison.truth.pixel_class[seen] = background;
    erased.comparison.receivers.triangle[seen] = no_triangle;
    erased.points[seen] = scene::Vec3f{std::numeric_limits<float>::quiet_NaN()};
    expect_refuted(erased, "it is unmatched: the exact ray sees triangle ");
    WallAov renamed;
    const std::size_t lit_pixel = renamed.find(lit);
    renamed.comparison.receivers.triangle[lit_pixel] ^= 1U;
    expect_refuted(renamed, "it is unmatched: the exact ray sees triangle ");
}

/// The message of the InputError that `gnomon certify` ends with.
std::string refusal(const WallAov& wall, const std::vector<std::string>& more,
                    const std::string& builtin = "wall")
{
    try {
        (void)wall.certify(more, builtin);
    } catch (const scene::InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(CertifyCommand, NamesWhatIsOfAnotherJob)
{
    const WallAov wall;
    EXPECT_THAT(refusal(wall, {"--set", "image.width=33"}),
                HasSubstr("the image is 32x24 pixels but the job's is 33x24"));
    EXPECT_THAT(refusal(wall, {"--set", "scene.wall.height_m=3"}), HasSubstr("gnomon:scene_hash"));
    EXPECT_THAT(refusal(wall, {"--set", "camera.eye=[0, 9, 9]"}), HasSubstr("gnomon:eye is 0x"));
    EXPECT_THAT(refusal(wall, {"--set", "light.direction=[0, -1, 0]"}),
                HasSubstr("gnomon:light_direction is "));
    EXPECT_THAT(refusal(wall, {}, "fence"), HasSubstr("give the job that the AOV was made from"));
}

} // namespace
} // namespace gnomon::cli
