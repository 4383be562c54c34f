// The gate finds changes in another renderer's cases.

#include "case_folder.hpp"
#include "run_folder.hpp"

#include "lane.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;
using JudgedJson = nlohmann::json;

/// A case with GL's shadows, and a baseline of its evaluation.
class JudgedCase {
public:
    JudgedCase(const std::string& scene, const std::vector<std::string>& more) : folder{scene, more}
    {
        expect_done(folder.evaluate({"--out", folder.at("before")}));
        expect_done(gnomon(
            {"baseline", "save", folder.at("before"), "--baseline", folder.at("baseline.json")}));
    }

    /// Each pixel's class in the evaluation.
    [[nodiscard]] scene::Image<scene::PixelClass> classes() const
    {
        for (const auto& file : std::filesystem::directory_iterator{folder.at("before/pixels")}) {
            if (file.path().extension() == ".exr") {
                return store::LayerFile{file.path(), "a test needs it"}.classes();
            }
        }
        ADD_FAILURE() << "no pixels were kept";
        return {};
    }

    /// Evaluates the case and runs the gate.
    [[nodiscard]] Ending judge() const
    {
        folder.write();
        std::filesystem::remove_all(folder.at("after"));
        const Ending evaluated = folder.evaluate({"--out", folder.at("after")});
        EXPECT_EQ(evaluated.exit_code, 0) << evaluated.err;
        return gnomon(
            {"gate", folder.at("after"), "--baseline", folder.at("baseline.json"), "--json"});
    }

    CaseFolder folder;
};

JudgedJson finding_of(const Ending& ending, const std::string& metric)
{
    const JudgedJson found = JudgedJson::parse(ending.out);
    for (const JudgedJson& finding : found.at("findings")) {
        if (finding.at("metric") == metric) {
            return finding;
        }
    }
    ADD_FAILURE() << metric << " in\n" << ending.out;
    return {};
}

/// Flips random correct pixels, in the order of rows.
std::set<std::pair<int, int>> flip_right_pixels(JudgedCase& judged, std::size_t count)
{
    const auto classes = judged.classes();
    auto& mask = judged.folder.channels["shadow.V"];
    const auto [width, height] = mask.size();
    std::set<std::pair<int, int>> flipped; // y first: in the order of rows
    std::mt19937 random{20};
    while (flipped.size() < count) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(width));
        const int y = static_cast<int>(random() % static_cast<unsigned>(height));
        const bool is_right = scene::is_scored(classes(x, y)) &&
                              (mask(x, y) > 0) == (classes(x, y) == scene::PixelClass::lit);
        if (is_right && flipped.emplace(y, x).second) {
            mask(x, y) = 1 - mask(x, y);
        }
    }
    return flipped;
}

TEST(EvaluateGate, NamesTwentyFlippedPixels)
{
    JudgedCase judged{tests::in_lane("sphere-plane", "columns"),
                      {"--set", tests::in_lane("image.width=640", "image.width=1280"), "--set",
                       tests::in_lane("image.height=400", "image.height=800")}}; // a million
    const auto flipped = flip_right_pixels(judged, 20);
    const JudgedJson found = finding_of(judged.judge(), "new_pixels");
    EXPECT_EQ(found.at("reason"), "worse_than_baseline");
    EXPECT_EQ(found.at("now"), 20);
    JudgedJson first = JudgedJson::array();
    for (const auto& [y, x] : flipped) {
        if (first.size() < 10) {
            first.push_back({x, y});
        }
    }
    EXPECT_EQ(found.at("pixels").at("first"), first);
    EXPECT_EQ(found.at("pixels").at("box").at(1), flipped.begin()->first);
    EXPECT_EQ(found.at("pixels").at("box").at(3), flipped.rbegin()->first);
    EXPECT_TRUE(std::filesystem::exists(found.at("picture").get<std::string>()));
    // The recorded depths contradict the flips, so no bias, map or filter is the cause.
    const Ending evaluated = judged.folder.evaluate();
    EXPECT_THAT(evaluated.out, HasSubstr("contradicts its own lookup at 20 scored pixels"));
}

TEST(EvaluateGate, FindsAMaskThatIsShiftedByOnePixel)
{
    JudgedCase judged{tests::in_lane("fence", "yard"), {}};
    auto& mask = judged.folder.channels["shadow.V"];
    const auto [width, height] = mask.size();
    for (int y = 0; y < height; ++y) {
        for (int x = width - 1; x > 0; --x) {
            mask(x, y) = mask(x - 1, y);
        }
    }
    const JudgedJson found = finding_of(judged.judge(), "new_pixels");
    EXPECT_GE(found.at("now"), 100);
    EXPECT_FALSE(found.at("dominant_cause").is_null());
    const Ending evaluated = judged.folder.evaluate({"--json"});
    EXPECT_GE(JudgedJson::parse(evaluated.out).at("evaluate").at("contradicted_pixels"), 100);
}

TEST(EvaluateGate, PassesTheSameCaseAgain)
{
    const JudgedCase judged{tests::in_lane("sphere-plane", "yard"), {}};
    const Ending ending = judged.judge();
    EXPECT_EQ(ending.exit_code, 0) << ending.out;
    EXPECT_TRUE(JudgedJson::parse(ending.out).at("findings").empty()) << ending.out;
    const Ending evaluated = judged.folder.evaluate({"--json"});
    EXPECT_EQ(JudgedJson::parse(evaluated.out).at("evaluate").at("contradicted_pixels"), 0);
}

} // namespace
} // namespace gnomon::testing
