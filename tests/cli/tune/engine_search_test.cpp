#include "cli/tune/engine_search.hpp"

#include "scene/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::cli {
namespace {

EngineKey number_key(const std::string& name, double lower, double upper, double start)
{
    return {name, scene::RealDomain{.lower = lower, .upper = upper}, start, "", "a number"};
}

EngineValues start_of(const std::vector<EngineKey>& keys)
{
    EngineValues values;
    for (const EngineKey& key : keys) {
        values[key.name] = key.default_value;
    }
    return values;
}

double number(const EngineValues& values, const std::string& name)
{
    return std::get<double>(values.at(name));
}

/// A measurement with this error; equal errors have equal frames.
EngineMeasure drawn(double error)
{
    return {error, std::hash<double>{}(error), false};
}

TEST(EngineSearch, FindsABiasOfAnyScale)
{
    const std::vector<EngineKey> keys{number_key("bias", -1, 1, 0)};
    for (const double broad_minimum : {-0.3, -0.004, 0.00002, 0.7}) {
        const auto result =
            search_engine(keys, {start_of(keys)}, 60, [&](const EngineValues& values) {
                const double bias = number(values, "bias");
                return drawn(bias * broad_minimum <= 0 ? 9.0
                                                       : std::abs(std::log(bias / broad_minimum)));
            });
        // The finest factors are at most 1.18 apart below the best value, and 1.2 above it.
        EXPECT_LT(result.error, 0.2) << broad_minimum;
        EXPECT_FALSE(result.is_exhausted);
    }
}

TEST(EngineSearch, TriesEveryChoiceAndComesBackToKeys)
{
    const std::vector<EngineKey> keys{
        number_key("bias", 0, 1, 0),
        {"kind", scene::WordDomain{{"a", "b", "c"}}, std::string{"a"}, "", "a choice"},
        {"flag", scene::FlagDomain{}, false, "", "a flag"},
        {"count", scene::IntegerDomain{1, 9}, std::int64_t{1}, "", "an integer"}};
    // The bias only matters with "c", which the first pass finds later.
    const auto result = search_engine(keys, {start_of(keys)}, 400, [](const EngineValues& values) {
        const bool is_c = std::get<std::string>(values.at("kind")) == "c";
        const double bias = is_c ? std::abs(number(values, "bias") - 0.1) : 0.0;
        return drawn(
            (is_c ? 1.0 : 5.0) + bias + (std::get<bool>(values.at("flag")) ? 0.0 : 1.0) +
            std::abs(static_cast<double>(std::get<std::int64_t>(values.at("count"))) - 9.0));
    });
    EXPECT_EQ(std::get<std::string>(result.best.at("kind")), "c");
    EXPECT_TRUE(std::get<bool>(result.best.at("flag")));
    EXPECT_EQ(std::get<std::int64_t>(result.best.at("count")), 9);
    EXPECT_NEAR(number(result.best, "bias"), 0.1, 1e-12); // one of the powers of ten
}

TEST(EngineSearch, LeavesAsItIsWhatChangesNothing)
{
    const std::vector<EngineKey> keys{number_key("idle", -5, 5, 0.25)};
    const auto result =
        search_engine(keys, {start_of(keys)}, 100, [](const EngineValues&) { return drawn(3); });
    EXPECT_EQ(number(result.best, "idle"), 0.25);
    EXPECT_EQ(result.error, 3.0);
    EXPECT_EQ(result.measured, 3U) << "the start, and the key's ends";
    EXPECT_EQ(result.dropped, (std::vector<DroppedKey>{{"idle", false}}));
}

TEST(EngineSearch, KeepsToItsBudgetAndPassesOverWhatCannotBeDrawn)
{
    const std::vector<EngineKey> keys{number_key("bias", 0, 1, 0)};
    std::size_t asked = 0;
    const auto result = search_engine(keys, {start_of(keys)}, 7, [&](const EngineValues& values) {
        ++asked;
        const double bias = number(values, "bias");
        return bias > 0.00002 ? EngineMeasure{} : drawn(1 - bias);
    });
    EXPECT_EQ(asked, 7U);
    EXPECT_EQ(result.measured, 7U);
    EXPECT_TRUE(result.is_exhausted);
    EXPECT_LE(number(result.best, "bias"), 0.00002);
}

TEST(EngineSearch, RejectsAStartThatCannotBeDrawn)
{
    const std::vector<EngineKey> keys{number_key("bias", 0, 1, 0)};
    EXPECT_THROW((void)search_engine(keys, {start_of(keys)}, 9,
                                     [](const EngineValues&) { return EngineMeasure{}; }),
                 std::invalid_argument);
}

TEST(EngineSearch, StartsFromTheBestKnownSettingAndIsNeverWorse)
{
    const std::vector<EngineKey> keys{number_key("bias", 0, 1000, 5)};
    // A minimum near a documented value, which steps around the default would miss.
    const EngineValues documented{{"bias", 0.0123}};
    const auto result =
        search_engine(keys, {start_of(keys), documented}, 40, [](const EngineValues& values) {
            return drawn(std::abs(number(values, "bias") - 0.0123) < 1e-4 ? 1.0 : 2.0);
        });
    EXPECT_EQ(result.error, 1.0);
    EXPECT_EQ(number(result.best, "bias"), 0.0123);
    // The budget ends before any step: the best known setting stays.
    const auto known =
        search_engine(keys, {start_of(keys), documented}, 2, [](const EngineValues& values) {
            return drawn(number(values, "bias") == 5 ? 3.0 : 4.0);
        });
    EXPECT_EQ(number(known.best, "bias"), 5);
    EXPECT_TRUE(known.is_exhausted);
}

TEST(EngineSearch, StepsByPowersOfTenFromAKnownValue)
{
    const std::vector<EngineKey> keys{number_key("bias", 0, 1e6, 0.5)};
    std::vector<double> asked;
    (void)search_engine(keys, {start_of(keys)}, 400, [&](const EngineValues& values) {
        asked.push_back(number(values, "bias"));
        return drawn(asked.size() == 1 ? 1.0 : 2.0 + static_cast<double>(asked.size()));
    });
    const std::vector<double> first(asked.begin(), asked.begin() + 9);
    // Its ends come before the steps.
    const std::vector<double> expected{0.5, 0, 1e6, 5, 0.05, 50, 0.005, 500, 0.0005};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_DOUBLE_EQ(first[i], expected[i]) << i;
    }
}

TEST(EngineSearch, NeverWinsByHidingWhatIsWrong)
{
    const std::vector<EngineKey> keys{
        {"side", scene::WordDomain{{"front", "double", "back"}}, std::string{"front"}, "", "seen"},
        number_key("bias", 0, 1, 0)};
    // Other sides show fewer pixels, and so fewer errors.
    const auto result = search_engine(keys, {start_of(keys)}, 60, [](const EngineValues& values) {
        const std::string side = std::get<std::string>(values.at("side"));
        if (side == "back") {
            return EngineMeasure{{}, 1, true};
        }
        return drawn((side == "double" ? 1 : 2) - number(values, "bias"));
    });
    EXPECT_EQ(std::get<std::string>(result.best.at("side")), "front");
    EXPECT_EQ(number(result.best, "bias"), 1);
    EXPECT_EQ(result.dropped, (std::vector<DroppedKey>{{"side", true}}));
}

using scene::LightType;

const std::vector<EngineKey> documented_keys{
    {"bias", scene::RealDomain{.lower = -1, .upper = 1}, 0.0, "", "a number"},
    {"soft", scene::FlagDomain{}, false, "", "a flag"}};

EngineValues read_documented(const std::string& text, LightType light)
{
    const std::filesystem::path file = testing::TempDir() + "gnomon_documented_values.toml";
    std::ofstream{file} << text;
    EngineValues values;
    try {
        values = documented_values(file, light, documented_keys);
    } catch (...) {
        std::filesystem::remove(file);
        throw;
    }
    std::filesystem::remove(file);
    return values;
}

TEST(DocumentedValues, AreThoseOfAllLightsAndOverThemOfTheOne)
{
    const std::string text = "title = \"an engine\"\n[documented]\nsource = \"its manual\"\n"
                             "engine = { bias = -0.5, soft = true }\npoint = { bias = 0.25 }\n";
    EXPECT_EQ(read_documented(text, LightType::spot),
              (EngineValues{{"bias", -0.5}, {"soft", true}}));
    EXPECT_EQ(read_documented(text, LightType::point),
              (EngineValues{{"bias", 0.25}, {"soft", true}}));
}

TEST(DocumentedValues, AreNoneWithoutATableOrAFile)
{
    EXPECT_TRUE(read_documented("title = \"an engine\"\n", LightType::spot).empty());
    EXPECT_TRUE(documented_values({}, LightType::spot, documented_keys).empty());
    EXPECT_TRUE(
        documented_values("/no/such/league.toml", LightType::spot, documented_keys).empty());
}

TEST(DocumentedValues, RefuseWhatTheEngineDoesNotTake)
{
    EXPECT_THROW((void)read_documented("[documented]\nengine = { bias = 7 }\n", LightType::spot),
                 scene::InputError);
    EXPECT_THROW((void)read_documented("[documented]\nengine = { depth = 0 }\n", LightType::spot),
                 scene::InputError);
}

} // namespace
} // namespace gnomon::cli
