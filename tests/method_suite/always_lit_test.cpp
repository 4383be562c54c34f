// Gnomon with a list of only one synthetic method.

#include "always_lit.hpp"
#include "child_process.hpp"
#include "compared.hpp"
#include "lane.hpp"
#include "methods/job_method.hpp"
#include "methods/list.hpp"
#include "methods_job.hpp"
#include "run_folder.hpp"
#include "scene/job/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Label;
using gnomon::testing::Ending;
using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<scene::Override> small{{"method.name", std::string{always_lit}},
                                         {"image.width", "160"},
                                         {"image.height", "90"},
                                         {"shadow_map.resolution", "128"}};

TEST(AlwaysLit, IsTheOnlyMethodThatIsLinked)
{
    ASSERT_EQ(methods::methods().size(), 1U);
    EXPECT_EQ(methods::methods()[0].name, always_lit);
    EXPECT_EQ(methods::find_method("depth"), nullptr);
    EXPECT_EQ(methods::find_method("vsm"), nullptr);
}

/// A comparison, and the scene that it points to.
struct AlwaysLitCase {
    scene::Job job;
    Compared scene;
    analysis::Comparison result;

    explicit AlwaysLitCase(const std::string& builtin,
                           const std::vector<scene::Override>& more = {})
        : job{job_of(builtin, more)},
          scene{job},
          result{scene(job)}
    {
    }

    static scene::Job job_of(const std::string& builtin, const std::vector<scene::Override>& more)
    {
        std::vector<scene::Override> keys = small;
        keys.insert(keys.end(), more.begin(), more.end());
        return tests::builtin_job(builtin, keys).job;
    }
};

void expect_all_lit(const analysis::Comparison& result, const std::string& label)
{
    const auto& metrics = result.metrics;
    const std::uint64_t blocked = metrics.pixels.of(scene::PixelClass::blocked);
    EXPECT_GT(blocked, 100U) << label;
    EXPECT_EQ(metrics.false_shadow, 0U) << label;
    EXPECT_EQ(metrics.false_lit, blocked) << label;
    EXPECT_EQ(metrics.amounts.shadow, 0) << label;
    EXPECT_EQ(metrics.amounts.light, static_cast<double>(blocked)) << label;
    EXPECT_EQ(metrics.amounts.unassigned, 0) << label;
    const auto& causes = result.diagnosis->causes;
    EXPECT_EQ(std::reduce(causes.counts.by_cause.begin(), causes.counts.by_cause.end()), blocked)
        << label;
    EXPECT_EQ(std::reduce(causes.counts.by_label.begin(), causes.counts.by_label.end()), blocked)
        << label;
    EXPECT_EQ(causes.counts.of(Cause::none), 0U) << label;
    EXPECT_EQ(causes.counts.of(Label::none), 0U) << label;
    // The method also lights exact depths and reads one texel, so only a finer map or the truth can
    // differ.
    EXPECT_EQ(causes.counts.of(Cause::bias) + causes.counts.of(Cause::precision) +
                  causes.counts.of(Cause::filter),
              0U)
        << label;
    for (std::size_t i = 0; i < causes.amounts.by_cause.size(); ++i) {
        EXPECT_EQ(causes.amounts.by_cause[i], static_cast<double>(causes.counts.by_cause[i]))
            << label << " cause " << i;
    }
    for (std::size_t i = 0; i < causes.amounts.by_label.size(); ++i) {
        EXPECT_EQ(causes.amounts.by_label[i], static_cast<double>(causes.counts.by_label[i]))
            << label << " label " << i;
    }
}

TEST(AlwaysLit, IsWrongInEveryBlockedPixelAndNowhereElse)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-plane", "sphere-cube", "columns"}) {
        for (const char* const bias : {"0", "0.01"}) {
            const AlwaysLitCase c{builtin, {{"bias.constant", bias}}};
            expect_all_lit(c.result, std::string{builtin} + " bias " + bias);
        }
    }
}

TEST(AlwaysLit, HasNoBiasThatShadows)
{
    GNOMON_REQUIRE_GL();
    const AlwaysLitCase c{"sphere-plane"};
    ASSERT_TRUE(c.result.diagnosis->biases.has_value());
    const auto& criticals = c.result.diagnosis->biases->critical_bias;
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        if (c.result.receivers.triangle[i] == scene::no_triangle) {
            continue;
        }
        ++receivers;
        ASSERT_EQ(criticals[i], -scene::infinity) << "pixel " << i;
    }
    EXPECT_GT(receivers, 1000U);
    const auto verified = analysis::verify_comparison(c.result, c.scene.renderers());
    ASSERT_TRUE(verified.has_value());
    EXPECT_FALSE(verified->reruns.empty());
    EXPECT_EQ(verified->differences(), 0U);
    for (const auto& rerun : verified->reruns) {
        EXPECT_EQ(rerun.shadowed, 0U) << "bias " << rerun.bias;
    }
}

/// The program with this list.
Ending program(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), GNOMON_ALWAYS_LIT);
    return gnomon::testing::run(arguments);
}

std::vector<std::string> with_small(std::vector<std::string> arguments)
{
    for (const scene::Override& key : small) {
        arguments.insert(arguments.end(), {"--set", key.key + "=" + key.value});
    }
    return arguments;
}

TEST(AlwaysLitProgram, ListsItAlone)
{
    const Ending ending = program({"methods", "--json"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const Json listed = Json::parse(ending.out);
    std::vector<std::string> names;
    for (const Json& method : listed) {
        names.push_back(method.at("name"));
    }
    EXPECT_THAT(names, ElementsAre(always_lit));
}

TEST(AlwaysLitProgram, RefusesTheMethodsThatItDoesNotHave)
{
    const Ending ending =
        program({"compare", "--builtin", "wall", "--set", "method.name=vsm", "--json"});
    EXPECT_EQ(ending.exit_code, 2);
    EXPECT_THAT(ending.err, HasSubstr("method.name"));
    EXPECT_THAT(ending.err, HasSubstr(std::string{always_lit}));
}

TEST(AlwaysLitProgram, ComparesAndWritesJson)
{
    GNOMON_REQUIRE_GL();
    const Ending ending =
        program(with_small({"compare", "--builtin", "sphere-plane", "--json", "--verify"}));
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const Json result = Json::parse(ending.out);
    EXPECT_EQ(result.at("schema"), 2);
    EXPECT_EQ(result.at("cause_arithmetic"), "float32");
    EXPECT_EQ(result.at("false_shadow"), 0);
    EXPECT_EQ(result.at("false_lit"), result.at("pixels").at("blocked"));
    for (const char* const counts : {"causes", "labels"}) {
        std::uint64_t all = 0;
        for (const auto& [name, count] : result.at(counts).items()) {
            all += count.get<std::uint64_t>();
        }
        EXPECT_EQ(all, result.at("false_lit")) << counts;
    }
}

TEST(AlwaysLitProgram, ComparesWithoutNamingAMethodWhereThereIsOnlyOne)
{
    GNOMON_REQUIRE_GL();
    const Ending ending = program({"compare", "--builtin", "sphere-plane", "--json", "--set",
                                   "image.width=64", "--set", "image.height=36"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("\"method.name\": \"always_lit\""));
}

TEST(AlwaysLitProgram, TunesToTheAnswerThatNothingServes)
{
    GNOMON_REQUIRE_GL();
    auto job = with_small({"tune", "--builtin", "sphere-plane", "--max-resolution", "256", "--time",
                           in_lane("2", "30")});
    const Ending ending = program(job);
    EXPECT_EQ(ending.exit_code, 1) << ending.err << ending.out;
    EXPECT_THAT(ending.out, HasSubstr("serves in this view"));
    EXPECT_THAT(ending.out,
                HasSubstr("still lights 100 % of what is blocked. Nothing is recommended."));
    EXPECT_THAT(ending.out, ::testing::Not(HasSubstr("No constant bias is needed")));
    auto verbose = job;
    verbose.emplace_back("--verbose");
    const Ending table = program(verbose);
    EXPECT_THAT(table.out, HasSubstr("Nothing is recommended."));
    EXPECT_THAT(table.out, ::testing::Not(HasSubstr("No constant bias is needed")));
    EXPECT_THAT(table.out, HasSubstr("measured in"));
    job.insert(job.end(), {"--json", "--quiet"});
    const Ending json = program(job);
    EXPECT_EQ(json.exit_code, 1) << json.err << json.out;
    const Json answer = Json::parse(json.out);
    EXPECT_TRUE(answer.at("recommended").is_null()) << answer.at("recommended");
    EXPECT_EQ(answer.at("toml"), "");
    EXPECT_FALSE(answer.contains("states"));
    EXPECT_EQ(answer.at("least_wrong").at("false_lit"), answer.at("measured").at("false_lit"));
    EXPECT_THAT(answer.at("why").at(0).get<std::string>(),
                HasSubstr("still lights 100 % of what is blocked; nothing is recommended"));
}

TEST(AlwaysLitProgram, Sweeps)
{
    GNOMON_REQUIRE_GL();
    const gnomon::testing::TemporaryFolder folder;
    const auto run = folder.path() / "run";
    const Ending ending = program(with_small({"sweep", "--builtin", "sphere-plane", "--out", run,
                                              "--axis", "shadow_map.roll_deg=0,10", "--axis",
                                              "bias.constant=0,0.001,0.02", "--quiet"}));
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const auto rows = gnomon::testing::csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 6U);
    for (const auto& row : rows) {
        EXPECT_EQ(row.at("status"), "done");
        EXPECT_EQ(row.at("method.name"), always_lit);
        EXPECT_EQ(row.at("false_shadow"), "0");
        EXPECT_EQ(row.at("false_lit"), row.at("pixels.blocked"));
    }
    EXPECT_EQ(program({"report", run, "--out", folder.path() / "page.html"}).exit_code, 0);
}

} // namespace
} // namespace gnomon::tests
