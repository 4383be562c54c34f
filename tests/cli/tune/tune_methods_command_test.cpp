// Searches over methods: predictions, methods passed over, refusals.

#include "child_process.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A map of 96² texels, for short searches.
std::vector<std::string> of_small_map(const std::string& command, const std::string& builtin,
                                      const std::vector<std::string>& more)
{
    std::vector<std::string> words{command, "--builtin", builtin, "--set",
                                   "shadow_map.resolution=96"};
    words.insert(words.end(), more.begin(), more.end());
    return small(std::move(words));
}

Json tuned_methods(const std::string& builtin, const std::string& methods)
{
    Start patient;
    patient.longest_s = 900; // a search over all methods on a busy machine
    const Ending ending =
        gnomon(of_small_map("tune", builtin, {"--methods", methods, "--json"}), patient);
    EXPECT_LE(ending.exit_code, 1) << ending.err;
    EXPECT_THAT(ending.err, HasSubstr("gnomon tune: at most "));
    return Json::parse(ending.out);
}

/// Each method's fragment, in a job of its own, gives the predicted errors.
void expect_promises_kept(const std::string& builtin, const std::string& methods)
{
    const Json result = tuned_methods(builtin, methods);
    const TemporaryFolder folder;
    for (const Json& method : result.at("methods")) {
        const auto job = folder.path() / "tuned.toml";
        std::ofstream{job} << fmt::format("[scene]\nbuiltin = \"{}\"\n", builtin)
                           << method.at("toml").get<std::string>();
        const Ending ending = gnomon(small({"compare", job.string(), "--json"}));
        expect_done(ending);
        const Json compared = Json::parse(ending.out);
        const Json& promised = method.at("recommended");
        const std::string told = builtin + ": " + method.at("name").get<std::string>() + "\n" +
                                 method.at("toml").get<std::string>();
        for (const char* const name :
             {"false_shadow", "false_lit", "shadow_amount", "light_amount"}) {
            EXPECT_EQ(compared.at(name), promised.at(name)) << name << " of " << told;
            EXPECT_EQ(compared.at(name), method.at("views")[0].at("measured").at(name))
                << name << " of " << told;
        }
        for (const char* const name : {"shadow_softening", "light_softening"}) {
            // A method without a map softens nothing.
            EXPECT_EQ(compared.at(name), promised.at(name)) << name << " of " << told;
        }
        EXPECT_LE(promised.at("map_bytes"), result.at("limits").at("max_bytes")) << told;
    }
}

TEST(TuneMethods, PrintsFragmentsWithWhichCompareMeasuresWhatWasPromised)
{
    // The usual lane skips the slowest searches; depth has its own tests.
    expect_promises_kept("sphere-plane", tests::in_lane("primitive_id,shadow_volumes",
                                                        "depth,primitive_id,shadow_volumes"));
    expect_promises_kept("wall", tests::in_lane("second_layer", "pcf,second_layer"));
}

TEST(LongTuneMethods, KeepsThePromisesOfEveryMethod)
{
    for (const char* const builtin : {"sphere-plane", "columns", "yard"}) {
        expect_promises_kept(builtin, "all");
    }
}

TEST(TuneMethods, RanksAndRecommendsTheFirst)
{
    const Json result = tuned_methods("wall", "primitive_id,shadow_volumes");
    const Json& methods = result.at("methods");
    ASSERT_EQ(methods.size(), 2U);
    // Volumes are exact up to float32 rounding; indices shadow every edge.
    EXPECT_EQ(methods[0].at("name"), "shadow_volumes");
    EXPECT_EQ(methods[1].at("name"), "primitive_id");
    EXPECT_EQ(result.at("toml"), methods[0].at("toml"));
    EXPECT_EQ(result.at("recommended").at("method.name"), "shadow_volumes");
    EXPECT_TRUE(result.at("recommended").at("shadow_map.resolution").is_null());
    EXPECT_TRUE(result.at("methods_passed_over").empty());
    EXPECT_LE(result.at("considered").size(), result.at("most_settings").get<std::size_t>());
    EXPECT_EQ(result.at("limits").at("max_bytes"), 96 * 96 * 4);
}

TEST(TuneMethods, SaysWhichItPassesOver)
{
    const Ending ending =
        gnomon(of_small_map("tune", "lamp-room",
                            {"--methods", "vsm,shadow_volumes", "--max-false-shadow", "50%",
                             "--max-false-lit", "50%"}));
    EXPECT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("vsm was passed over: method.name = \"vsm\": its kernels"));
    EXPECT_THAT(ending.out, HasSubstr("name = \"shadow_volumes\""));
}

TEST(TuneMethods, LeavesTheResultWithoutThemAsItWas)
{
    const Ending ending =
        gnomon(of_small_map("tune", "wall", {"--max-resolution", "256", "--json"}));
    const Json result = Json::parse(ending.out);
    for (const char* const name : {"methods", "methods_passed_over", "most_settings"}) {
        EXPECT_FALSE(result.contains(name)) << name;
    }
    EXPECT_FALSE(result.at("recommended").contains("method.name"));
    EXPECT_FALSE(result.at("limits").contains("max_bytes"));
}

TEST(TuneMethods, RefusesWhatIsNone)
{
    expect_refused(gnomon(of_small_map("tune", "wall", {"--methods", "vsmm"})), 2,
                   "methods vsmm: unknown method (did you mean vsm?); use all, or some "
                   "of depth,vsm");
    expect_refused(gnomon(of_small_map("tune", "wall", {"--max-bytes", "1000"})), 2,
                   "--max-bytes needs --methods");
    expect_refused(gnomon(of_small_map("compare", "wall", {"--methods", "pcf"})), 2,
                   "--methods needs --advise");
    expect_refused(gnomon(small({"tune", "--builtin", "wall", "--set", "method.name=shadow_volumes",
                                 "--methods", "depth"})),
                   2, "set a limit on their bytes");
}

TEST(CompareAdvise, HasRemediesOfOtherMethodsThatLeaveWhatIsSaid)
{
    const Ending ending = gnomon(of_small_map(
        "compare", "wall", {"--advise", "--methods", "second_layer,shadow_volumes", "--json"}));
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const Json result = Json::parse(ending.out);
    EXPECT_TRUE(result.at("methods_passed_over").empty());
    std::size_t tried = 0;
    for (const Json& remedy : result.at("remedies")) {
        const auto keys = remedy.at("keys").get<std::vector<std::string>>();
        if (!keys.front().starts_with("method.name")) {
            continue;
        }
        std::vector<std::string> words;
        for (const std::string& key : keys) {
            words.insert(words.end(), {"--set", key.substr(0, key.find(" #"))});
        }
        const bool has_map = remedy.at("map_bytes").get<std::uint64_t>() > 0;
        words.emplace_back("--json");
        const Ending again = gnomon(has_map ? of_small_map("compare", "wall", words) : [&] {
            std::vector<std::string> all{"compare", "--builtin", "wall"};
            all.insert(all.end(), words.begin(), words.end());
            return small(std::move(all));
        }());
        expect_done(again);
        for (const char* const name : {"false_shadow", "false_lit", "shadow_amount"}) {
            EXPECT_EQ(Json::parse(again.out).at(name), remedy.at(name)) << keys.front();
        }
        ++tried;
    }
    EXPECT_EQ(tried, 2U);
}

} // namespace
} // namespace gnomon::testing
