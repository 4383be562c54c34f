#include "cli/renderer/tune/engine_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
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

TEST(EngineSearch, FindsABiasOfAnyScale)
{
    const std::vector<EngineKey> keys{number_key("bias", -1, 1, 0)};
    for (const double valley : {-0.3, -0.004, 0.00002, 0.7}) {
        const auto result =
            search_engine(keys, start_of(keys), 60, [&](const EngineValues& values) {
                const double bias = number(values, "bias");
                return std::optional{bias * valley <= 0 ? 9.0 : std::abs(std::log(bias / valley))};
            });
        // The finest factors are 1.18 apart or less below the best, and 1.2 above it.
        EXPECT_LT(result.amount, 0.2) << valley;
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
    const auto result = search_engine(keys, start_of(keys), 400, [](const EngineValues& values) {
        const bool is_c = std::get<std::string>(values.at("kind")) == "c";
        const double bias = is_c ? std::abs(number(values, "bias") - 0.1) : 0.0;
        return std::optional{
            (is_c ? 1.0 : 5.0) + bias + (std::get<bool>(values.at("flag")) ? 0.0 : 1.0) +
            std::abs(static_cast<double>(std::get<std::int64_t>(values.at("count"))) - 9.0)};
    });
    EXPECT_EQ(std::get<std::string>(result.best.at("kind")), "c");
    EXPECT_TRUE(std::get<bool>(result.best.at("flag")));
    EXPECT_EQ(std::get<std::int64_t>(result.best.at("count")), 9);
    EXPECT_NEAR(number(result.best, "bias"), 0.1, 1e-12); // one of the powers of ten
}

TEST(EngineSearch, LeavesAsItIsWhatChangesNothing)
{
    const std::vector<EngineKey> keys{number_key("idle", -5, 5, 0.25)};
    const auto result = search_engine(keys, start_of(keys), 100,
                                      [](const EngineValues&) { return std::optional{3.0}; });
    EXPECT_EQ(number(result.best, "idle"), 0.25);
    EXPECT_EQ(result.amount, 3.0);
}

TEST(EngineSearch, KeepsToItsBudgetAndPassesOverWhatCannotBeDrawn)
{
    const std::vector<EngineKey> keys{number_key("bias", 0, 1, 0)};
    std::size_t asked = 0;
    const auto result = search_engine(keys, start_of(keys), 7, [&](const EngineValues& values) {
        ++asked;
        const double bias = number(values, "bias");
        return bias > 0.00001 ? std::nullopt : std::optional{1 - bias};
    });
    EXPECT_EQ(asked, 7U);
    EXPECT_EQ(result.measured, 7U);
    EXPECT_TRUE(result.is_exhausted);
    EXPECT_LE(number(result.best, "bias"), 0.00001);
}

TEST(EngineSearch, RejectsAStartThatCannotBeDrawn)
{
    const std::vector<EngineKey> keys{number_key("bias", 0, 1, 0)};
    EXPECT_THROW((void)search_engine(
                     keys, start_of(keys), 9,
                     [](const EngineValues&) -> std::optional<double> { return std::nullopt; }),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::cli
