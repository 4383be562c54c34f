// Jobs with cascades: results, layers, sweeps, advice.

#include "child_process.hpp"
#include "exr_layers.hpp"
#include "lane.hpp"
#include "row_compared.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::HasSubstr;
using CascadeJson = nlohmann::json;

/// In the usual lane the columns have few faces.
const std::string columns = std::string{"[scene]\nbuiltin = \"columns\"\n"} +
                            tests::in_lane("columns.slices = 16\n", "") +
                            "[image]\nwidth = 192\nheight = 108\n";

const std::string four_cascades = columns + R"([shadow_map]
layout = "cascades"
resolution = 128
)";

CascadeJson json_from(std::vector<std::string> arguments)
{
    arguments.emplace_back("--json");
    const Ending ending = gnomon(arguments);
    EXPECT_EQ(ending.exit_code, 0) << ending.command << "\n" << ending.err;
    return CascadeJson::parse(ending.out);
}

class CascadesCommand : public ::testing::Test {
protected:
    [[nodiscard]] path at(const std::string& name) const { return folder_.path() / name; }
    [[nodiscard]] path job(const std::string& more = {}) const
    {
        return folder_.write("job.toml", four_cascades + more);
    }

private:
    TemporaryFolder folder_;
};

TEST_F(CascadesCommand, TellOfEachMapWhatItSeesAndWhatTheBiasIsThere)
{
    const CascadeJson json = json_from(
        {"compare", job(), "--set", "bias.constant_m=0.05", "--set", "bias.normal_texels=2"});
    const CascadeJson& maps = json.at("by_map");
    ASSERT_EQ(maps.size(), 4U);
    std::uint64_t wrong = 0;
    std::uint64_t scored = 0;
    double end_m = maps[0].at("begin_m");
    for (const CascadeJson& map : maps) {
        EXPECT_EQ(map.at("begin_m"), end_m);
        end_m = map.at("end_m");
        const CascadeJson& bias = map.at("bias");
        const double range_m = map.at("far_m").get<double>() - map.at("near_m").get<double>();
        const double texel_m = map.at("texel_m");
        // Three roundings to float32: of the bias, its scale, and their product's place here.
        EXPECT_NEAR(bias.at("constant_m").get<double>(), 0.05, 0.05 * 3 * 0x1p-24);
        EXPECT_DOUBLE_EQ(bias.at("constant_m").get<double>(),
                         bias.at("constant").get<double>() * range_m);
        EXPECT_DOUBLE_EQ(bias.at("constant_texels").get<double>(),
                         bias.at("constant_m").get<double>() / texel_m);
        EXPECT_DOUBLE_EQ(bias.at("normal_offset_m").get<double>(), 2 * texel_m);
        wrong +=
            map.at("false_shadow").get<std::uint64_t>() + map.at("false_lit").get<std::uint64_t>();
        scored += map.at("lit").get<std::uint64_t>() + map.at("blocked").get<std::uint64_t>();
    }
    EXPECT_EQ(wrong, json.at("false_shadow").get<std::uint64_t>() +
                         json.at("false_lit").get<std::uint64_t>());
    EXPECT_EQ(scored, json.at("pixels").at("lit").get<std::uint64_t>() +
                          json.at("pixels").at("blocked").get<std::uint64_t>());
    const Ending table = gnomon({"compare", job(), "--verbose"});
    EXPECT_THAT(table.out, HasSubstr("4 of 128x128 d24, cascades"));
    EXPECT_THAT(table.out, HasSubstr("cascades        0: view depth "));
    EXPECT_THAT(table.out, HasSubstr("in map           false shadow"));
}

/// The first slice ends before any visible surface, so its texels do not matter.
TEST_F(CascadesCommand, TellLengthsWhereTheyAreReadAndNameThoseThatNoPixelReads)
{
    const path unread = job("split_lambda = 0.95\ncascade_near = 0.001\ncascade_far = 30\n"
                            "[bias]\nconstant_m = 0.02\n");
    const CascadeJson json = json_from({"compare", unread});
    const CascadeJson& maps = json.at("by_map");
    const auto readers = [](const CascadeJson& map) {
        return map.at("lit").get<std::uint64_t>() + map.at("blocked").get<std::uint64_t>();
    };
    ASSERT_EQ(readers(maps[0]), 0U);
    EXPECT_THAT(json.at("findings").back().get<std::string>(),
                HasSubstr("No scored pixel reads cascade 0, from 0.001 to "));
    const auto most =
        std::max_element(maps.begin(), maps.end(), [&](const CascadeJson& a, const CascadeJson& b) {
            return readers(a) < readers(b);
        });
    const CascadeJson& recommended = json.at("bias_curve").at("recommended");
    ASSERT_GT(recommended.at("bias_m").get<double>(), 0);
    // One division in either order: 2 roundings of a double.
    EXPECT_NEAR(recommended.at("bias_texels").get<double>() * most->at("texel_m").get<double>(),
                recommended.at("bias_m").get<double>(),
                recommended.at("bias_m").get<double>() * 0x1p-51);
    const Ending table = gnomon({"compare", unread, "--verbose"});
    EXPECT_THAT(table.out, HasSubstr("; no scored pixel reads it"));
    EXPECT_THAT(table.out, HasSubstr(fmt::format("texels in cascade {})",
                                                 most->at("map").get<std::string>())));
    const Ending answer = gnomon({"compare", unread});
    EXPECT_THAT(answer.out,
                HasSubstr("\nwarning   No scored pixel reads cascade 0, from 0.001 to "));
    EXPECT_THAT(answer.out, HasSubstr(fmt::format(" texels in cascade {}\n",
                                                  most->at("map").get<std::string>())));
}

TEST_F(CascadesCommand, AreTheSameInASweepAsAlone)
{
    const bool is_full = tests::runs_full_tests();
    std::map<std::vector<std::string>, CascadeJson> alone;
    // Each row by a comparison of its own, or by its curve.
    for (const std::string pixels : {"--keep-pixels", "--no-keep-pixels"}) {
        // The usual lane tries each filter and each blend one way.
        const bool is_kept = pixels == "--keep-pixels";
        const path sweep = job(fmt::format(
            "[sweep]\n\"shadow_map.cascades\" = [2, 4]\n\"bias.constant_m\" = [0.01, 0.2]\n"
            "\"lookup.filter\" = [{}]\n\"shadow_map.blend\" = [{}]\n",
            is_full   ? R"("nearest", "pcf3")"
            : is_kept ? R"("nearest")"
                      : R"("pcf3")",
            is_full   ? "0, 0.2"
            : is_kept ? "0.2"
                      : "0"));
        const path run = at("run" + pixels);
        const Ending ending = gnomon({"sweep", sweep, "--out", run, pixels, "--verify", "--quiet"});
        ASSERT_EQ(ending.exit_code, 0) << ending.err;
        const auto rows = csv_rows(run / "results.csv");
        ASSERT_EQ(rows.size(), tests::in_lane(4U, 16U));
        for (std::size_t i = 0; i < rows.size(); i += tests::in_lane(3U, 1U)) {
            const auto& row = rows[i];
            std::vector<std::string> command{"compare", sweep};
            for (const char* key :
                 {"shadow_map.cascades", "shadow_map.blend", "bias.constant_m", "lookup.filter"}) {
                command.insert(command.end(), {"--set", fmt::format("{}={}", key, row.at(key))});
            }
            if (!alone.contains(command)) {
                alone[command] = json_from(command);
            }
            expect_row_compares(row, alone.at(command));
        }
    }
}

/// Predictions for other lights agree with GL in the job's own view.
TEST_F(CascadesCommand, AreTunedOverLightsInTheUnitThatIsTold)
{
    const path depth_units = job("[bias]\nconstant = 0.001\n");
    const Ending tuned =
        gnomon({"tune", depth_units, "--lights", "1", "--max-resolution", "256", "--json"});
    const CascadeJson result = CascadeJson::parse(tuned.out);
    ASSERT_TRUE(result.at("recommended").contains("bias.constant_m")) << tuned.err;
    const path rounded = at("pasted.toml");
    std::ofstream{rounded} << columns << result.at("toml").get<std::string>();
    const CascadeJson compared = json_from({"compare", rounded});
    EXPECT_EQ(compared.at("false_shadow"), result.at("measured").at("false_shadow"));
    EXPECT_EQ(compared.at("false_lit"), result.at("measured").at("false_lit"));
}

TEST_F(CascadesCommand, HaveTheirIndexInTheLayersAndAMapEach)
{
    const Ending ending =
        gnomon({"compare", job(), "--aov", at("a.exr"), "--depth-map", at("d.exr")});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const store::ExrLayers layers = store::read_exr(at("a.exr"));
    EXPECT_TRUE(layers.channels.contains("map_index"));
    for (const char* attribute : {"gnomon:light_clip_from_world_3", "gnomon:near_3", "gnomon:far_0",
                                  "gnomon:slice_end_2"}) {
        EXPECT_TRUE(layers.texts.contains(attribute)) << attribute;
    }
    const auto maps = store::read_exr_parts(at("d.exr"));
    ASSERT_EQ(maps.size(), 4U);
    for (const store::ExrLayers& map : maps) {
        EXPECT_EQ(map.width_px, 128);
    }
    EXPECT_EQ(gnomon({"certify", at("a.exr"), job(), "--sample", "300"}).exit_code, 0);
}

TEST_F(CascadesCommand, AreEvaluatedAsAnotherRenderersMask)
{
    const CascadeJson own = json_from({"compare", job(), "--export-case", at("case")});
    const CascadeJson evaluated = json_from({"evaluate", at("case")});
    for (const char* member : {"false_shadow", "false_lit", "causes", "by_map"}) {
        EXPECT_EQ(evaluated.at(member), own.at(member)) << member;
    }
    ASSERT_EQ(
        gnomon({"compare", job(), "--set", "shadow_map.blend=0.2", "--export-case", at("mixed")})
            .exit_code,
        0);
    const Ending mixed = gnomon({"evaluate", at("mixed"), "--verbose"});
    EXPECT_EQ(mixed.exit_code, 0) << mixed.err;
    EXPECT_THAT(mixed.out, HasSubstr("needs shadow_map.blend = 0"));
}

TEST_F(CascadesCommand, AreTunedAndAdvised)
{
    const std::vector<std::string> tune{"tune", job(), "--max-resolution", "256"};
    std::vector<std::string> with_json = tune;
    with_json.emplace_back("--json");
    const CascadeJson tuned = CascadeJson::parse(gnomon(with_json).out); // meets the limits or not
    std::set<int> counts;
    std::set<double> lambdas;
    for (const CascadeJson& setting : tuned.at("considered")) {
        EXPECT_EQ(setting.at("shadow_map.cascade_fit"), "tight"); // auto slices cannot be stable
        counts.insert(setting.at("shadow_map.cascades").get<int>());
        lambdas.insert(setting.at("shadow_map.split_lambda").get<double>());
    }
    EXPECT_EQ(counts, (std::set<int>{2, 3, 4}));
    EXPECT_EQ(lambdas, (std::set<double>{0.5, 0.9}));

    std::vector<std::string> with_keys = tune;
    with_keys.emplace_back("--quiet");
    const path rounded = at("pasted.toml");
    std::ofstream{rounded} << columns << gnomon(with_keys).out;
    const CascadeJson compared = json_from({"compare", rounded});
    EXPECT_EQ(compared.at("false_shadow"), tuned.at("recommended").at("false_shadow"));
    EXPECT_EQ(compared.at("false_lit"), tuned.at("recommended").at("false_lit"));

    const Ending advised = gnomon({"compare", job(), "--advise"});
    EXPECT_THAT(advised.out, HasSubstr("shadow_map.cascades = 8"));
}

TEST_F(CascadesCommand, RefuseWhatTheyCannotSeeInOneLine)
{
    const Ending behind = gnomon({"compare", job(), "--set", "shadow_map.cascade_near=500"});
    EXPECT_EQ(behind.exit_code, 2);
    EXPECT_THAT(behind.err, HasSubstr("shadow_map.cascade_near = 500 is not below "
                                      "shadow_map.cascade_far = "));
    const Ending spot =
        gnomon({"compare", "--builtin", "two-distances", "--set", "shadow_map.layout=cascades"});
    EXPECT_EQ(spot.exit_code, 2);
    EXPECT_THAT(spot.err, HasSubstr("light.type = \"directional\""));
    const Ending orthographic =
        gnomon({"compare", job(), "--set", "camera.orthographic_height=12"});
    EXPECT_EQ(orthographic.exit_code, 0) << orthographic.err;
}

} // namespace
} // namespace gnomon::testing
