#include "child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using Json = nlohmann::json;

TEST(Program, AnswersHelpAndVersion)
{
    for (const char* const command :
         {"compare", "scenes", "methods", "init", "doctor", "completion"}) {
        const Ending ending = gnomon({command, "--help"});
        expect_done(ending);
        EXPECT_THAT(ending.out, HasSubstr("Usage: gnomon " + std::string{command}));
    }
    const Ending help = gnomon({"--help"});
    expect_done(help);
    EXPECT_THAT(help.out, HasSubstr("Examples:"));
    const Ending version = gnomon({"--version"});
    expect_done(version);
    EXPECT_THAT(version.out, ::testing::MatchesRegex("gnomon [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Manual, AsMarkdownIsThePageOfTheDocumentation)
{
    const Ending ending = gnomon({"manual", "--markdown"});
    expect_done(ending);
    if (std::getenv("GNOMON_UPDATE_DOCUMENTS") != nullptr) {
        std::ofstream{GNOMON_ROOT "/docs/commands.md"} << ending.out;
    }
    EXPECT_EQ(text_of(GNOMON_ROOT "/docs/commands.md"), ending.out)
        << "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R cli_program_test writes it anew";
}

TEST(Manual, NamesEveryCommandAndHoldsNoRequestOfItsOwn)
{
    const Ending ending = gnomon({"manual"});
    expect_done(ending);
    for (const char* const command : {"compare", "sweep", "gate", "baseline save", "manual"}) {
        EXPECT_THAT(ending.out, HasSubstr(".SS gnomon " + std::string{command} + "\n"));
    }
    EXPECT_THAT(ending.out, HasSubstr(".B \\-\\-set TEXT\n"));
    const std::set<std::string> requests{".TH", ".SH", ".SS", ".TP", ".PP",
                                         ".B",  ".I",  ".RI", ".nf", ".fi"};
    std::istringstream lines{ending.out};
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('.') || line.starts_with('\'')) {
            EXPECT_TRUE(requests.contains(line.substr(0, line.find(' ')))) << line;
        }
    }
}

TEST(Help, PrintsWhatTheOptionPrints)
{
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{}, {"compare"}, {"baseline", "save"}, {"help"}}) {
        std::vector<std::string> help{"help"};
        help.insert(help.end(), command.begin(), command.end());
        std::vector<std::string> option = command;
        option.emplace_back("--help");
        const Ending ending = gnomon(help);
        expect_done(ending);
        EXPECT_EQ(ending.out, gnomon(option).out);
    }
}

TEST(Init, WritesAJobThatCompares)
{
    const TemporaryFolder folder;
    const std::string job = folder.path() / "job.toml";
    expect_done(gnomon({"init", job}));
    EXPECT_EQ(gnomon({"init"}).out, text_of(job));
    const Ending ending = gnomon(small({"compare", job}));
    expect_done(ending);
    EXPECT_THAT(ending.out, HasSubstr("sphere-cube"));
}

TEST(Init, KeepsAFileThatExists)
{
    const TemporaryFolder folder;
    const std::string job = folder.write("job.toml", "mine");
    expect_refused(gnomon({"init", job}), 2, "pass --force to replace it");
    EXPECT_EQ(text_of(job), "mine");
    expect_done(gnomon({"init", "--force", job}));
    EXPECT_NE(text_of(job), "mine");
}

/// Whether the default is inside the range, or one of the words.
void expect_sound_parameter(const Json& parameter)
{
    EXPECT_NE(parameter.at("name"), "");
    EXPECT_NE(parameter.at("description"), "");
    EXPECT_TRUE(parameter.at("unit").is_string());
    const Json& value = parameter.at("default");
    if (parameter.at("type") == "word") {
        const Json& words = parameter.at("words");
        EXPECT_NE(std::find(words.begin(), words.end(), value), words.end());
        return;
    }
    const Json& range = parameter.at("range");
    ASSERT_EQ(range.size(), 2U);
    EXPECT_LE(range[0].get<double>(), value.get<double>());
    EXPECT_GE(range[1].get<double>(), value.get<double>());
}

TEST(Scenes, ListsEveryBuiltinWithItsParameters)
{
    const Ending ending = gnomon({"scenes", "--json"});
    expect_done(ending);
    std::set<std::string> names;
    for (const Json& builtin : Json::parse(ending.out)) {
        SCOPED_TRACE(builtin.at("name"));
        names.insert(builtin.at("name"));
        for (const Json& parameter : builtin.at("parameters")) {
            SCOPED_TRACE(parameter.at("name"));
            expect_sound_parameter(parameter);
        }
    }
    EXPECT_EQ(names,
              (std::set<std::string>{"sphere-cube", "sphere-plane", "yard", "playground",
                                     "two-distances", "tilted-plane", "wall", "room", "lamp-room",
                                     "fence", "terrain", "columns", "sphere-field"}));
    const std::string table = gnomon({"scenes"}).out;
    for (const std::string& name : names) {
        EXPECT_THAT(table, HasSubstr(name));
    }
}

TEST(Methods, ListsFiltersBiasTermsAndKeysThatAJobTakes)
{
    const Ending ending = gnomon({"methods", "--json"});
    expect_done(ending);
    const Json json = Json::parse(ending.out);
    ASSERT_EQ(json.size(), 10U);
    const std::vector<std::string> names{
        "depth",          "vsm", "esm",  "evsm",        "msm", "primitive_id",
        "shadow_volumes", "pcf", "pcss", "second_layer"};
    for (std::size_t i = 0; i < json.size(); ++i) {
        EXPECT_EQ(json[i].at("name"), names[i]);
        EXPECT_EQ(json[i].at("promises").at("has_map"), names[i] != "shadow_volumes");
    }
    std::set<std::string> filters;
    for (const Json& filter : json[0].at("filters")) {
        filters.insert(filter.at("name"));
    }
    EXPECT_EQ(filters,
              (std::set<std::string>{"nearest", "linear", "hardware", "pcf3", "pcf5", "pcf7",
                                     "pcf9", "bilinear3", "bilinear5", "bilinear7"}));
    const std::string job = gnomon({"init"}).out;
    for (const Json& method : json) {
        for (const Json& key : method.at("keys")) {
            const std::string name = key.at("name");
            EXPECT_THAT(job, HasSubstr(name.substr(name.find('.') + 1) + " = ")) << name;
        }
    }
    const Ending table = gnomon({"methods"});
    expect_done(table);
    for (const std::string& filter : filters) {
        EXPECT_THAT(table.out, HasSubstr("\n  " + filter + " "));
    }
}

TEST(Methods, RejectsAName)
{
    expect_refused(gnomon({"methods", "depth"}), 2, "depth");
}

TEST(Doctor, NamesWhatItFinds)
{
    const Ending ending = gnomon({"doctor", "--json"});
    expect_done(ending);
    const Json found = Json::parse(ending.out);
    EXPECT_NE(found.at("gl").at("renderer"), "");
    EXPECT_GE(found.at("gl").at("subpixel_bits"), 4); // the least that OpenGL allows
    EXPECT_FALSE(found.at("devices").empty());
    EXPECT_TRUE(found.at("depth_formats").contains("d24"));
    EXPECT_THAT(found.at("embree").get<std::string>(), HasSubstr("Embree"));
    EXPECT_GT(found.at("available_memory_bytes"), 0);
    EXPECT_TRUE(found.at("problems").empty());
    const Ending text = gnomon({"doctor"});
    expect_done(text);
    EXPECT_THAT(text.out, HasSubstr(found.at("gl").at("renderer").get<std::string>()));
}

/// Environments in which EGL has no context.
std::vector<std::string> machines_without_egl()
{
    std::vector<std::string> machines{"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent",
                                      "__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"};
    // Newer versions of Mesa's EGL link their drivers instead of searching for them.
    if (run({"sh", "-c", "ls /usr/lib/*/libgallium-*.so"}).exit_code != 0) {
        machines.emplace_back("LIBGL_DRIVERS_PATH=/nonexistent");
    }
    return machines;
}

TEST(WithoutEgl, CompareSaysWhatToInstall)
{
    for (const std::string& machine : machines_without_egl()) {
        Start start;
        start.environment = {machine};
        expect_refused(gnomon(small({"compare", "--builtin", "wall"}), start), 4,
                       "apt-get install");
    }
}

TEST(WithoutEgl, CompareSurvivesALibraryThatCannotBeLoaded)
{
    const TemporaryFolder folder;
    folder.write("libEGL.so.1", "this is no library");
    Start start;
    start.environment = {"LD_LIBRARY_PATH=" + folder.path().string()};
    expect_refused(gnomon(small({"compare", "--builtin", "wall"}), start), 4, "libEGL.so.1");
}

TEST(WithoutEgl, DoctorSaysWhatIsMissing)
{
    for (const std::string& machine : machines_without_egl()) {
        Start start;
        start.environment = {machine};
        const Ending ending = gnomon({"doctor", "--json"}, start);
        EXPECT_EQ(ending.exit_code, 4) << machine;
        const Json found = Json::parse(ending.out);
        EXPECT_TRUE(found.at("gl").is_null());
        ASSERT_EQ(found.at("problems").size(), 1U);
        EXPECT_THAT(found.at("problems")[0].get<std::string>(), HasSubstr("apt-get install"));
    }
}

TEST(Device, ThatDoesNotExistIsABadArgument)
{
    for (const char* const device : {"99", "-1"}) {
        for (const std::vector<std::string>& command :
             {small({"compare", "--builtin", "wall"}), {"depth"}, {"doctor"}}) {
            std::vector<std::string> arguments = command;
            arguments.insert(arguments.end(), {"--device", device});
            expect_refused(gnomon(arguments), 2,
                           fmt::format("--device {}: EGL lists only 0", device));
        }
    }
}

TEST(WithoutEgl, NoDeviceIsTheArgumentsFault)
{
    Start start;
    start.environment = {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent"};
    expect_refused(gnomon({"depth", "--device", "99"}, start), 4, "apt-get install");
}

/// Bash's completions after these words; the last one is incomplete.
std::set<std::string> completions(const std::string& script_path, const std::string& words)
{
    const Ending ending =
        run({"bash", "-c",
             fmt::format("source {}; COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); "
                         "_gnomon 2>/dev/null; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                         script_path, words)});
    std::istringstream lines{ending.out};
    return {std::istream_iterator<std::string>{lines}, {}};
}

TEST(Completion, OffersCommandsOptionsAndNamesInBash)
{
    if (!is_installed("bash")) {
        GTEST_SKIP() << "bash is not installed";
    }
    const TemporaryFolder folder;
    const Ending ending = gnomon({"completion", "bash"});
    expect_done(ending);
    const std::string script = folder.write("gnomon.bash", ending.out);
    expect_done(run({"bash", "-n", script}));
    using Words = std::set<std::string>;
    EXPECT_EQ(completions(script, "gnomon comp"), (Words{"compare", "completion"}));
    EXPECT_THAT(completions(script, "gnomon ''"),
                IsSupersetOf({"compare", "doctor", "init", "scenes", "methods", "completion"}));
    EXPECT_EQ(completions(script, "gnomon compare --builtin sphere-"),
              (Words{"sphere-cube", "sphere-field", "sphere-plane"}));
    EXPECT_THAT(completions(script, "gnomon compare --"),
                IsSupersetOf({"--aov", "--json", "--picture", "--set"}));
    EXPECT_THAT(completions(script, "gnomon compare --set shadow_map.r"),
                IsSupersetOf({"shadow_map.resolution=", "shadow_map.reversed="}));
    EXPECT_EQ(completions(script, "gnomon figure error"),
              (Words{"error-vs-axis", "error-vs-z", "errors-vs-z"}));
    EXPECT_EQ(completions(script, "gnomon completion ''"), (Words{"bash", "fish", "zsh"}));
    EXPECT_EQ(completions(script, "gnomon baseline ''"), (Words{"--help", "diff", "list", "save"}));
    EXPECT_THAT(completions(script, "gnomon baseline save run --"), IsSupersetOf({"--baseline"}));
    EXPECT_THAT(completions(script, "gnomon gate run --"),
                IsSupersetOf({"--allow-environment", "--baseline", "--json", "--rules"}));
}

/// The shell itself must accept its script.
void expect_script_parses(const std::string& shell)
{
    const Ending ending = gnomon({"completion", shell});
    expect_done(ending);
    EXPECT_THAT(ending.out, HasSubstr("gnomon"));
    if (!is_installed(shell)) {
        GTEST_SKIP() << shell << " is not installed";
    }
    const TemporaryFolder folder;
    expect_done(run({shell, "-n", folder.write("script", ending.out)}));
}

TEST(Completion, ParsesInZsh)
{
    expect_script_parses("zsh");
}

TEST(Completion, ParsesInFish)
{
    expect_script_parses("fish");
}

} // namespace
} // namespace gnomon::testing
