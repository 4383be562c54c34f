#include "renderer/fake_renderer.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;

/// A broken rule, and a part of its line.
struct BrokenLine {
    std::string rule;
    std::string words;
};

/// A way to misbehave, and the findings.
struct Misbehaviour {
    std::string way; ///< its first argument
    std::vector<BrokenLine> broken;
    double longest_s = 30; ///< for each answer; short if one never comes
};

std::ostream& operator<<(std::ostream& stream, const Misbehaviour& misbehaviour)
{
    return stream << misbehaviour.way;
}

Ending check(const FakeRenderer& renderer, double longest_s)
{
    return gnomon({"renderer-check", "--command", renderer.command(), "--renderer-timeout-s",
                   fmt::format("{}", longest_s), "--json"},
                  renderer.start());
}

class MisbehavingRenderer : public ::testing::TestWithParam<Misbehaviour> {};

TEST_P(MisbehavingRenderer, BreaksARuleInOneLineAndLeavesNothing)
{
    const FakeRenderer renderer{GetParam().way};
    const Ending ending = check(renderer, GetParam().longest_s);
    EXPECT_EQ(ending.err, "");
    ASSERT_EQ(ending.exit_code, GetParam().broken.empty() ? 0 : 1) << ending.out;
    const auto json = nlohmann::json::parse(ending.out);
    std::vector<nlohmann::json> broken;
    for (const auto& rule : json.at("rules")) {
        if (!rule.at("kept").get<bool>()) {
            broken.push_back(rule);
        }
    }
    ASSERT_EQ(broken.size(), GetParam().broken.size()) << ending.out;
    for (std::size_t i = 0; i < broken.size(); ++i) {
        EXPECT_EQ(broken[i].at("rule"), GetParam().broken[i].rule);
        EXPECT_THAT(broken[i].at("sentence").get<std::string>(),
                    HasSubstr(GetParam().broken[i].words));
    }
    renderer.expect_nothing_left();
}

const std::vector<Misbehaviour>& misbehaviours()
{
    static const std::string first = "draw, directional light";
    static const std::vector<Misbehaviour> all{
        {"sound", {}},
        {"floods_stderr", {}},
        {"says_method", {}},
        {"lights", {}},
        {"locks_folder", {}},
        {"forks", {}},
        {"dies_at_hello",
         {{"hello", "it ended with exit status 1; its last words: no display to open"}}},
        {"hangs_at_hello", {{"hello", "no answer within 3 s"}}, 3},
        {"talks", {{"hello", "not JSON: \"Loading shaders ...\""}}},
        {"other_protocol", {{"hello", "protocol is 2; this Gnomon speaks 1"}}},
        {"key_twice", {{"hello", "keys has \"bias\" twice"}}},
        {"name_twice", {{"hello", "\"name\" is given twice"}}},
        {"default_outside", {{"hello", "keys[0].default of \"bias\" is 7"}}},
        {"no_device", {{"hello", "device is missing"}}},
        {"closes_stdout", {{"hello", "it closed its standard output"}}},
        {"bad_conventions", {{"open", "conventions.up = \"w\""}}},
        {"dies_at_draw",
         {{first, "signal 11 ended it; its last words: assertion failed: shadow atlas"}}},
        {"dies_of_fork", {{first, "its last words: the GPU process is gone"}}},
        {"hangs_at_draw", {{first, "no answer within 6 s"}}, 6},
        {"floods_stdout", {{first, "without an end of line: \"xxx"}}},
        {"floods_for_ever", {{first, "no answer within 6 s"}}, 6},
        {"other_id", {{first, "the answer's id is 4; it was asked 3"}}},
        {"no_seconds", {{first, "seconds is missing"}}},
        {"unknown_member", {{first, "file is not known"}}},
        {"no_frame", {{first, "it says ok, but there is no frame"}}},
        {"half_a_frame", {{first, "there is no such file beside the frame"}}},
        {"truncated_exr", {{first, "frame.exr: "}}},
        {"link", {{first, "that is no plain file"}}},
        {"pipe", {{first, "that is no plain file"}}},
        {"file_outside", {{first, "files are named without a folder"}}},
        {"wrong_size", {{first, "were asked for"}}},
        {"nan_mask", {{first, "shadow.V is NaN"}}},
        {"inverted", {{first, "the mask is inverted"}}},
        {"bad_case", {{first, "lookup.filter = \"blurry\""}}},
        {"old_frame", {{"draw, point light", "an old frame"}}},
        {"unequal",
         {{"same frame", "two equal requests gave frames that are not equal: the mask differs at 1 "
                         "pixel"},
          {"no memory", "the first one gives another frame than before"}}},
        {"remembers", {{"no memory", "the first one gives another frame than before"}}},
        {"says_yes", {{"unknown key", "it says ok to lookup.no_such_key"}}},
        {"blames_nobody",
         {{"keys of the job", "the error does not name shadow_map.depth_format"},
          {"unknown key", "the error does not name lookup.no_such_key"}}},
        {"writes_outside", {{"files", "it wrote stray.txt beside its folder"}}},
        {"stays", {{"close", "it did not end within 5 s"}}},
        {"fails_at_close", {{"close", "it ended with exit status 1; it must be 0"}}},
    };
    return all;
}

INSTANTIATE_TEST_SUITE_P(All, MisbehavingRenderer, ::testing::ValuesIn(misbehaviours()),
                         [](const auto& info) { return info.param.way; });

/// The second answer may come at any time.
TEST(RendererCheck, HearsAnswersThatNobodyAskedFor)
{
    const FakeRenderer renderer{"answers_twice"};
    const Ending ending = check(renderer, 30);
    EXPECT_EQ(ending.exit_code, 1);
    EXPECT_THAT(ending.out, HasSubstr("than it was asked for: "));
    renderer.expect_nothing_left();
}

TEST(RendererCheck, NamesWhatItCannotStart)
{
    const Ending ending = gnomon({"renderer-check", "--command", "no-such-program --fast"});
    EXPECT_EQ(ending.exit_code, 1);
    EXPECT_THAT(ending.out, HasSubstr("no-such-program: cannot be run: No such file"));
    const Ending misspelt = gnomon({"renderer-check", "--command", "python3 --fast my/rendrer.py"});
    EXPECT_EQ(misspelt.exit_code, 1);
    EXPECT_THAT(misspelt.out, HasSubstr("; there is no file my/rendrer.py in "));
    expect_refused(gnomon({"renderer-check"}), 2, "no renderer: give its NAME");
    expect_refused(gnomon({"renderer-check", "no_such_engine"}), 2,
                   "renderer \"no_such_engine\": not installed");
    expect_refused(gnomon({"renderer-check", "--command", "'python3"}), 2,
                   "a quote ' is not closed");
}

TEST(LastWords, AreNoStackTraces)
{
    const Ending ending =
        gnomon({"renderer-check", "--command",
                "/usr/bin/python3 -c 'def draw(): raise ValueError(\"no display\")\ndraw()'"});
    EXPECT_THAT(ending.out,
                HasSubstr("Traceback (most recent call last): | ValueError: no display"));
}

TEST(Renderers, SayWhatTheirChecksFindMissing)
{
    const Ending ending = gnomon({"renderers", "--json"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const auto renderers = nlohmann::json::parse(ending.out).at("renderers");
    ASSERT_FALSE(renderers.empty());
    for (const auto& renderer : renderers) {
        const std::string name = renderer.at("name");
        const bool is_ready = renderer.at("ready");
        EXPECT_EQ(renderer.at("missing").is_null(), is_ready) << name;
        if (!is_ready) {
            EXPECT_THAT(renderer.at("missing").get<std::string>(),
                        HasSubstr(": ./dev engines " + name));
        }
        const bool is_program = name == "ogre" || name == "osg" || name == "qtquick3d";
        if (!is_ready && is_program) { // not built yet
            EXPECT_THAT(gnomon({"renderer-check", name}).out, HasSubstr("./dev engines " + name));
        }
    }
}

TEST(RendererCheck, LeavesNothingWhenItIsInterruptedOrKilled)
{
    for (const int signal : {SIGINT, SIGKILL}) {
        const FakeRenderer renderer{"hangs_at_draw"};
        Start start = renderer.start();
        start.while_running = [signal](pid_t process) {
            std::this_thread::sleep_for(std::chrono::seconds{2});
            ::kill(process, signal);
        };
        (void)gnomon({"renderer-check", "--command", renderer.command()}, start);
        renderer.expect_nothing_left();
    }
}

} // namespace
} // namespace gnomon::testing
