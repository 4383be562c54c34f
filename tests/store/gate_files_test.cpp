#include "analysis/gate/gate_metrics.hpp"
#include "reports/gate/gate_rule_file.hpp"
#include "scene/error.hpp"
#include "store/baseline/baseline.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/images/png.hpp"
#include "store/run/error_buckets_json.hpp"

#include "example_comparison.hpp"
#include "example_run.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<analysis::ErrorBucket> example_cells{
    {"a \"wall\"\n", analysis::light_distance_band_of(0.2F), 9, 0, {}},
    {"floor",
     analysis::light_distance_band_of(-5),
     3,
     2,
     {{false, analysis::Cause::bias, analysis::Label::overshadow, 1, 0.75}}},
    {"floor",
     analysis::light_distance_band_of(4),
     90,
     10,
     {{false, analysis::Cause::resolution, analysis::Label::acne, 7, 7},
      {false, analysis::Cause::filter, analysis::Label::edge, 0, 2.5},
      {true, analysis::Cause::coverage, analysis::Label::leak, 1, 1}}}};

TEST(ErrorBuckets, ReadBackAsTheyWereWritten)
{
    const Json json = Json::parse(error_buckets_json(example_cells).dump());
    EXPECT_EQ(error_buckets_from_json(json, "parts"), example_cells);
    const Json& floor = json.at("floor");
    EXPECT_EQ(floor.at("[4, 8)").at("false_lit.coverage.leak"), 1);
    EXPECT_FALSE(floor.at("[4, 8)").contains("light_amount.coverage.leak")) << "whole pixels";
    EXPECT_EQ(floor.at("[4, 8)").at("shadow_amount.filter.edge"), 2.5);
    EXPECT_FALSE(floor.at("[4, 8)").contains("false_shadow.filter.edge")) << "none is wrong";
    EXPECT_EQ(floor.at("[-8, -4)").at("shadow_amount.bias.overshadow"), 0.75);
    for (int index = analysis::LightDistanceBand::lowest;
         index <= analysis::LightDistanceBand::highest; ++index) {
        EXPECT_EQ(band_from_text(band_text({index})), analysis::LightDistanceBand{index}) << index;
    }
}

TEST(ErrorBuckets, RefuseWhatTheyAreNot)
{
    const auto refusal = [](const std::string& text) {
        try {
            (void)error_buckets_from_json(Json::parse(text), "parts");
        } catch (const scene::InputError& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    EXPECT_THAT(refusal("[]"), HasSubstr("parts: must be an object"));
    EXPECT_THAT(refusal(R"x({"a": {}})x"), HasSubstr("parts.a: must be an object with bands"));
    EXPECT_THAT(refusal(R"x({"a": {"[4, 9)": {"lit": 1, "blocked": 0}}})x"),
                HasSubstr("is not a band of light distance"));
    EXPECT_THAT(refusal(R"x({"a": {"[4, 8)": {"lit": 1}}})x"), HasSubstr("\"blocked\""));
    EXPECT_THAT(refusal(R"x({"a": {"[4, 8)": {"lit": -1, "blocked": 0}}})x"),
                HasSubstr("lit: must be a pixel count"));
    EXPECT_THAT(
        refusal(R"x({"a": {"[4, 8)": {"lit": 1, "blocked": 0, "false_lit.none.leak": 1}}})x"),
        HasSubstr("is not a pixel kind"));
    EXPECT_THAT(
        refusal(
            R"x({"a": {"[4, 8)": {"lit": 1, "blocked": 0, "shadow_amount.bias.overshadow": -1}}})x"),
        HasSubstr("must be an amount of pixels"));
}

analysis::PixelMask random_mask(std::uint32_t seed)
{
    std::mt19937 random{seed};
    analysis::PixelMask mask{{37, 23}};
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        mask[i] = random() % 5 == 0 ? 1 : 0;
    }
    return mask;
}

bool are_equal_masks(const analysis::PixelMask& a, const analysis::PixelMask& b)
{
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

/// The message for an invalid mask; empty if it is accepted.
std::string mask_refusal(const std::filesystem::path& baseline, const std::string& name,
                         scene::ImageSize size = {37, 23})
{
    try {
        (void)read_mask(baseline, name, size);
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return {};
}

TEST(PixelMaskFile, ReadsBackAsItWasWritten)
{
    const TemporaryFolder folder;
    const std::filesystem::path baseline = folder / "b.json";
    const analysis::PixelMask mask = random_mask(1);
    const std::string name = write_mask(baseline, mask);
    EXPECT_TRUE(is_mask_name(name)) << name;
    EXPECT_TRUE(are_equal_masks(read_mask(baseline, name, mask.size()), mask));
    EXPECT_NE(mask_name(random_mask(2)), name);
    EXPECT_NE(mask_name(analysis::PixelMask{{2, 3}}), mask_name(analysis::PixelMask{{3, 2}}));
}

TEST(PixelMaskFile, IsRefusedIfItIsMissingOrAnother)
{
    const TemporaryFolder folder;
    const std::filesystem::path baseline = folder / "b.json";
    EXPECT_THROW((void)read_mask(baseline, "0123456789abcdef", {37, 23}), BaselineMissing);
    const std::string name = write_mask(baseline, random_mask(1));
    EXPECT_THAT(mask_refusal(baseline, name, {23, 37}),
                HasSubstr("37x23 pixels, but the baseline's images are 23x37"));
    const auto path = masks_folder(baseline) / (name + ".png");
    std::filesystem::rename(
        masks_folder(baseline) / (write_mask(baseline, random_mask(2)) + ".png"), path);
    EXPECT_THAT(mask_refusal(baseline, name), HasSubstr("do not match its name"));
    std::ofstream{path} << "no image";
    EXPECT_THAT(mask_refusal(baseline, name), HasSubstr("not a PNG image"));
    const auto bytes = encode_png(RgbImage{{37, 23}});
    std::ofstream{path, std::ios::binary}.write(
        static_cast<const char*>(static_cast<const void*>(bytes.data())),
        static_cast<std::streamsize>(bytes.size()));
    EXPECT_THAT(mask_refusal(baseline, name), HasSubstr("one grey channel"));
}

/// Calls `check(text, what)` with seeded damage of a text: a byte flipped, removed or doubled, or
/// the end cut off.
void for_each_damage(const std::string& text, int count,
                     const std::function<void(const std::string&, const std::string&)>& check)
{
    for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(count); ++seed) {
        std::mt19937 random{seed};
        const std::size_t place = random() % text.size();
        std::string damaged = text;
        switch (random() % 4) {
        case 0:
            damaged[place] = static_cast<char>(damaged[place] ^ (1 << random() % 8));
            break;
        case 1:
            damaged.erase(place, 1 + random() % 20);
            break;
        case 2:
            damaged.insert(place, damaged.substr(place, 1 + random() % 20));
            break;
        default:
            damaged.resize(place);
        }
        if (damaged != text) {
            check(damaged, fmt::format("seed {}, byte {} of {}", seed, place, text.size()));
        }
    }
}

TEST(DamagedMasks, AreRefusedOrHoldTheSamePixels)
{
    const TemporaryFolder folder;
    const std::filesystem::path baseline = folder / "b.json";
    const analysis::PixelMask mask = random_mask(1);
    const std::string name = write_mask(baseline, mask);
    const auto path = masks_folder(baseline) / (name + ".png");
    for_each_damage(read_text(path), 400, [&](const std::string& bytes, const std::string& what) {
        std::ofstream{path, std::ios::binary} << bytes;
        try {
            EXPECT_TRUE(are_equal_masks(read_mask(baseline, name, mask.size()), mask)) << what;
        } catch (const scene::InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("restore it")) << what;
        }
    });
}

/// Those of `example_cells`.
const std::map<std::string, double> example_metrics{{"pixels.total", 921'600},
                                                    {"pixels.lit", 102},
                                                    {"pixels.blocked", 12},
                                                    {"false_shadow", 8},
                                                    {"false_lit", 1},
                                                    {"false_shadow_rate", 8.0 / 102},
                                                    {"false_lit_rate", 1.0 / 12},
                                                    {"error_rate", 9.0 / 114},
                                                    {"causes.bias", 1},
                                                    {"causes.precision", 0},
                                                    {"causes.resolution", 7},
                                                    {"causes.coverage", 1},
                                                    {"causes.filter", 0},
                                                    {"labels.acne", 7},
                                                    {"labels.peter_panning", 0},
                                                    {"labels.leak", 1},
                                                    {"labels.edge", 0},
                                                    {"labels.overshadow", 1},
                                                    {"labels.bleed", 0},
                                                    {"shadow_amount", 10.25},
                                                    {"light_amount", 1},
                                                    {"unassigned", 0},
                                                    {"cause_amounts.bias", 0.75},
                                                    {"cause_amounts.precision", 0},
                                                    {"cause_amounts.resolution", 7},
                                                    {"cause_amounts.coverage", 1},
                                                    {"cause_amounts.filter", 2.5},
                                                    {"label_amounts.acne", 7},
                                                    {"label_amounts.peter_panning", 0},
                                                    {"label_amounts.leak", 1},
                                                    {"label_amounts.edge", 2.5},
                                                    {"label_amounts.overshadow", 0.75},
                                                    {"label_amounts.bleed", 0},
                                                    {"softening", 2.5},
                                                    {"shadow_softening", 2.5},
                                                    {"light_softening", 0}};

analysis::GateEntries example_entries()
{
    const TemporaryFolder folder;
    ExampleRun{1, 2}.compute(folder / "run");
    analysis::GateEntries entries = read_gate_run(folder / "run").results;
    entries.entries[0].cells = example_cells;
    entries.entries[0].metrics = example_metrics;
    entries.entries[0].pixels = "0123456789abcdef";
    return entries;
}

TEST(DamagedBaselines, AreRefusedInOneLineOrAreAnotherBaseline)
{
    const analysis::GateEntries entries = example_entries();
    const std::string text = baseline_json(entries);
    EXPECT_EQ(baseline_json(parse_baseline(text, "b.json")), text);
    const int count = tests::in_lane(600, 3000);
    for_each_damage(text, count, [&](const std::string& damaged, const std::string& what) {
        try {
            (void)baseline_json(parse_baseline(damaged, "b.json"));
        } catch (const scene::InputError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("b.json: "), Not(HasSubstr("\n")))) << what;
        }
    });
}

TEST(DamagedBaselines, ContradictThemselvesWhereANumberIsEdited)
{
    const Json whole = Json::parse(baseline_json(example_entries()));
    (void)parse_baseline(whole.dump(), "b.json");
    for (const auto& [name, value] : example_metrics) {
        Json edited = whole;
        Json& metric = edited["configurations"][0]["metrics"][name];
        metric = name.ends_with("_rate") ? Json(value / 2) : Json(metric.get<double>() + 1);
        EXPECT_THROW((void)parse_baseline(edited.dump(), "b.json"), scene::InputError) << name;
    }
    Json edited = whole;
    edited["configurations"][0]["parts"]["floor"]["[4, 8)"]["false_shadow.resolution.acne"] = 6;
    EXPECT_THROW((void)parse_baseline(edited.dump(), "b.json"), scene::InputError);
    edited = whole;
    edited["configurations"][0]["parts"]["floor"]["[4, 8)"]["shadow_amount.filter.edge"] = 2;
    EXPECT_THROW((void)parse_baseline(edited.dump(), "b.json"), scene::InputError);
}

TEST(DamagedRuleFiles, AreRefusedInOneLineOrAreOtherRules)
{
    const std::string text = R"([[rule]]
id = "leaks of the wall"
metric = "labels.leak"
where = {shadow_map.resolution = 512, object = "wall", zeta_band = [4, 16], cause = "coverage"}
job = "changed"
max = 100
allow_pixels = 3
direction = "up"
severity = "warn"
optional = true
[[rule]]
id = "curve"
metric = "bias_curve.at(1e-3).false_shadow"
rel = 0.5
)";
    EXPECT_EQ(reports::parse_gate_rules(text, "gate.toml").size(), 2U);
    for_each_damage(text, 3000, [&](const std::string& damaged, const std::string& what) {
        try {
            EXPECT_FALSE(reports::parse_gate_rules(damaged, "gate.toml").empty()) << what;
        } catch (const scene::InputError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr("gate.toml"), Not(HasSubstr("\n")))) << what;
        }
    });
}

TEST(Baseline, HoldsCellsAndTheMasksNames)
{
    const analysis::GateEntries entries = example_entries();
    const analysis::GateEntries back = parse_baseline(baseline_json(entries), "b.json");
    EXPECT_EQ(back.entries[0].cells, example_cells);
    EXPECT_EQ(back.entries[0].pixels, "0123456789abcdef");
    EXPECT_TRUE(back.entries[1].pixels.empty());
    Json json = Json::parse(baseline_json(entries));
    json["configurations"][0]["wrong_pixels"] = "../../etc/passwd";
    EXPECT_THROW((void)parse_baseline(json.dump(), "b.json"), scene::InputError);
}

TEST(Baseline, LeavesNoMasksOfAnOlderOne)
{
    const TemporaryFolder folder;
    const std::filesystem::path baseline = folder / "b.json";
    analysis::GateEntries entries = example_entries();
    const std::string old = write_mask(baseline, random_mask(1));
    entries.entries[0].pixels = write_mask(baseline, random_mask(2));
    std::ofstream{masks_folder(baseline) / "notes.txt"} << "mine";
    write_baseline(baseline, entries);
    EXPECT_FALSE(exists(masks_folder(baseline) / (old + ".png")));
    EXPECT_TRUE(exists(masks_folder(baseline) / (entries.entries[0].pixels + ".png")));
    EXPECT_TRUE(exists(masks_folder(baseline) / "notes.txt"));
}

TEST(GateRun, KnowsDepthErrorsAndPointsOfTheCurve)
{
    const TemporaryFolder folder;
    ExampleRun{1, 1}.compute(folder / "run");
    std::vector<analysis::CurvePointMetric> points;
    for (const double bias : {0.0, 1e-6, 1e-6 * 1.11, 1.0}) {
        points.push_back({bias, "false_shadow"});
    }
    const auto run = read_gate_run(folder / "run", points);
    const auto value = [&](std::size_t i) {
        return run.results.entries.front().metric(points[i].name());
    };
    // The example's points lie at 1e-6 · 1.01^(10 i) and have 1000 − 10 i pixels.
    EXPECT_EQ(value(0), 1000) << "below the first, as at the first";
    EXPECT_EQ(value(1), 1000);
    EXPECT_EQ(value(2), 990) << "the largest bias not above it: 1.01^10 = 1.1046";
    EXPECT_EQ(value(3), 10);
}

} // namespace
} // namespace gnomon::store
