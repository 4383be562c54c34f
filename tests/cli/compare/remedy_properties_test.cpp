// Properties of every listed remedy and cause, over built-in scenes, bias terms and formats.

#include "child_process.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;

constexpr auto scenes = std::to_array<std::string_view>(
    {"sphere-plane", "sphere-cube", "wall", "fence", "room", "yard", "playground", "terrain",
     "columns", "two-distances", "tilted-plane", "sphere-field"});

/// Every bias term with too small or too large a value; further keys follow after a comma.
constexpr auto bias_terms = std::to_array<std::string_view>({
    "bias.constant=0",
    "bias.constant=0.1",
    "bias.slope=0.05",
    "bias.slope_kernels=1",
    "bias.constant_texels=1",
    "bias.normal_texels=2",
    "bias.normal_m=0.2",
    "bias.polygon_offset_factor=1.5",
    "bias.polygon_offset_factor=-2,bias.polygon_offset_units=-2",
    "bias.receiver_plane=analytic,lookup.filter=pcf3",
    "bias.adaptive_m=0.001",
});
constexpr auto formats = std::to_array<std::string_view>({"d16", "d24", "d32f"});

/// A job's errors, in the measures of remedies.
struct Errors {
    double wrong = 0;
    double amount = 0;
    double unsoftened = 0;
    double light = 0; ///< amount of light on what is in shadow [px]
};

Errors errors_of(const Json& json)
{
    const double light = json.at("light_amount").get<double>();
    const double amount = json.at("shadow_amount").get<double>() + light;
    return {json.at("false_shadow").get<double>() + json.at("false_lit").get<double>(), amount,
            json.at("error_amount").get<double>(), light};
}

/// The largest difference of a sum in another order: at most 160 × 90 terms of at most 1 px, and
/// each addition rounds by less than 2^-53 of the sum.
constexpr double rounding_px = 14400.0 * 14400.0 / 9007199254740992.0 + 1e-6;

using Words = std::vector<std::string>;

Json compared(const Words& job, const Words& more)
{
    Words arguments{"compare"};
    arguments.insert(arguments.end(), job.begin(), job.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.emplace_back("--json");
    const Ending ending = gnomon(small(arguments));
    EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err;
    return Json::parse(ending.out, nullptr, false);
}

std::string job_text(const Words& job)
{
    return fmt::format("{}", fmt::join(job, " "));
}

Words set_words(const Json& keys)
{
    Words words;
    for (const std::string& key : keys.get<Words>()) {
        words.insert(words.end(), {"--set", key.substr(0, key.find(" #"))});
    }
    return words;
}

bool is_of_job(const Json& change)
{
    return !change.at("keys")[0].get<std::string>().starts_with("#");
}

/// One remedy, run by itself.
void expect_remedy_kept(const Words& job, const Json& now, const Json& remedy, bool is_first)
{
    const std::string told = fmt::format("{}: {}", job_text(job), remedy.at("toml").dump());
    const Errors before = errors_of(now);
    const Errors said = errors_of(remedy);
    if (is_of_job(remedy)) {
        const Errors left = errors_of(compared(job, set_words(remedy.at("keys"))));
        EXPECT_EQ(left.wrong, said.wrong) << told;
        EXPECT_NEAR(left.amount, said.amount, rounding_px) << told;
        EXPECT_NEAR(left.unsoftened, said.unsoftened, rounding_px) << told;
    }
    EXPECT_LT(said.unsoftened, before.unsoftened) << told;
    const auto names = remedy.at("not_lessened").get<Words>();
    const auto is_named = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    EXPECT_EQ(is_named("wrong_pixels"), said.wrong >= before.wrong) << told;
    EXPECT_EQ(is_named("amount"), said.amount >= before.amount) << told;
    if (is_first) {
        EXPECT_LE(said.wrong, before.wrong) << told;
        EXPECT_LE(said.amount, before.amount) << told;
    }
    const double blocked = now.at("pixels").at("blocked").get<double>();
    EXPECT_LE(said.light, blocked / 2) << told;
    EXPECT_LE(remedy.at("false_lit").get<double>(), blocked / 2) << told;
}

/// Expects that one cure, run by itself, removes half of the errors of its cause.
void expect_cure_kept(const Words& job, const Json& now, const Json& cure)
{
    if (!cure.at("cures").get<bool>() || !is_of_job(cure)) {
        return;
    }
    const Errors left = errors_of(compared(job, set_words(cure.at("keys"))));
    EXPECT_GE(errors_of(now).unsoftened - left.unsoftened + rounding_px,
              cure.at("laid").get<double>() / 2)
        << fmt::format("{}: {}", job_text(job), cure.dump());
}

/// The words by which sentences name a cause as the one to act on.
constexpr auto text_of_causes = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"the map's resolution", "resolution"},
    {"finer texels", "resolution"},
    {"the precision of depths", "precision"},
    {"the format d32f", "precision"},
    {"an origin nearby", "precision"},
    {"the filter's footprint", "filter"},
    {"a single tap", "filter"},
    {"what the map does not cover", "coverage"},
    {"a map of the whole scene", "coverage"},
    {"due to the bias", "bias"},
    {"only bias.", "bias"},
    {"as bias.", "bias"},
    {"which bias.", "bias"},
});

void expect_named_causes_cured(const Words& job, const Json& now)
{
    for (const Json& finding : now.at("findings")) {
        for (const auto& [words, cause] : text_of_causes) {
            if (finding.get_ref<const std::string&>().find(words) == std::string::npos) {
                continue;
            }
            const Json& cures = now.at("cures");
            EXPECT_TRUE(std::any_of(cures.begin(), cures.end(),
                                    [&](const Json& cure) {
                                        return cure.at("cause") == cause &&
                                               cure.at("cures").get<bool>();
                                    }))
                << job_text(job) << finding;
        }
    }
}

/// Expects that if the sentence says that the first remedy cures a cause, not only "in part", it
/// leaves at most half of its errors.
void expect_cured_names(const Words& job, const Json& now)
{
    constexpr auto nouns =
        std::to_array<std::pair<const char*, const char*>>({{"acne", "acne"},
                                                            {"peter-panning", "peter_panning"},
                                                            {"leaks", "leak"},
                                                            {"overshadow", "overshadow"}});
    if (now.at("remedies").empty() || !is_of_job(now.at("remedies")[0])) {
        return;
    }
    std::optional<Json> left;
    for (const Json& finding : now.at("findings")) {
        for (const auto& [noun, label] : nouns) {
            const bool is_said = ::testing::Matches(::testing::ContainsRegex(fmt::format(
                "is {}[^;.]* which "
                "(this bias cures|these biases cure|this change cures)( for the most part)?[;.,]",
                noun)))(finding.get<std::string>());
            if (!is_said) {
                continue;
            }
            if (!left) {
                left = compared(job, set_words(now.at("remedies")[0].at("keys")));
            }
            EXPECT_LE(left->at("label_amounts").at(label).get<double>(),
                      now.at("label_amounts").at(label).get<double>() / 2 + rounding_px)
                << job_text(job) << finding;
        }
    }
}

Words job_of(std::size_t cell)
{
    const std::size_t format = cell % formats.size();
    const std::size_t term = cell / formats.size() % bias_terms.size();
    const std::size_t scene = cell / formats.size() / bias_terms.size();
    Words job{"--builtin", std::string{scenes.at(scene)},
              "--set",     fmt::format("shadow_map.depth_format={}", formats.at(format)),
              "--set",     "bias.slope=0",
              "--set",     "bias.constant=0",
              "--set",     "shadow_map.resolution=512"};
    std::string_view keys = bias_terms.at(term);
    while (!keys.empty()) {
        const std::size_t end = std::min(keys.find(','), keys.size());
        job.insert(job.end(), {"--set", std::string{keys.substr(0, end)}});
        keys.remove_prefix(std::min(end + 1, keys.size()));
    }
    return job;
}

constexpr std::size_t cell_count = scenes.size() * bias_terms.size() * formats.size();

/// @param most_reruns  of remedies; the first is always one of them.
void expect_cell_kept(std::size_t cell, std::size_t most_reruns, std::mt19937& random)
{
    const Words job = job_of(cell);
    const Json now = compared(job, {"--advise"});
    ASSERT_TRUE(now.is_object());
    std::vector<std::size_t> order(now.at("remedies").size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    if (order.size() > 1) {
        std::shuffle(order.begin() + 1, order.end(), random);
    }
    for (const std::size_t i : order) {
        if (i == order.front() || most_reruns > 1) {
            expect_remedy_kept(job, now, now.at("remedies")[i], i == 0);
            most_reruns -= most_reruns > 1 ? 1 : 0;
        }
    }
    for (const Json& cure : now.at("cures")) {
        expect_cure_kept(job, now, cure);
    }
    expect_named_causes_cured(job, now);
    expect_cured_names(job, now);
}

TEST(RemedyProperties, HoldOnASampleOfScenesBiasesAndFormats)
{
    constexpr unsigned seed = 52;
    const int cells = tests::in_lane(2, 4);
    std::mt19937 random{seed};
    std::uniform_int_distribution<std::size_t> any_cell{0, cell_count - 1};
    for (int i = 0; i < cells; ++i) {
        const std::size_t cell = any_cell(random);
        SCOPED_TRACE(fmt::format("seed {}, cell {}", seed, cell));
        expect_cell_kept(cell, tests::in_lane(2U, 3U), random);
    }
}

TEST(LongRemedyProperties, HoldOverAllScenesBiasesAndFormats)
{
    std::mt19937 random{1};
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
        SCOPED_TRACE(fmt::format("cell {}", cell));
        expect_cell_kept(cell, 64, random);
    }
}

} // namespace
} // namespace gnomon::testing
