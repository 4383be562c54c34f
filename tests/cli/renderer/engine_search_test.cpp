#include "cli/tune/engine_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

/// A frame with that error, and with the same pixels as all that have it.
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
        // The finest factors are 1.18 apart or less below the best, and 1.2 above it.
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
    // The bias matters with "c" alone, which the first pass finds after it.
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
    // A valley about a documented value, which steps about the default would miss.
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
    // The other sides show less, and so less that is wrong.
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

} // namespace
} // namespace gnomon::cli
