#include "child_process.hpp"
#include "cli/figures/figures.hpp"
#include "cli/system/child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::testing {
namespace {

using cli::FigureFile;
using ::testing::HasSubstr;
using ::testing::StartsWith;

bool can_draw()
{
    return run({cli::system_python, "-c", "import matplotlib, pandas"}).exit_code == 0;
}

/// A run of four configurations in a folder.
std::string small_run(const TemporaryFolder& folder)
{
    std::string out = folder.path() / "run";
    expect_done(gnomon({"sweep", "--builtin", "sphere-plane", "--set", "image.width=32", "--set",
                        "image.height=24", "--axis", "bias.constant=0,0.01", "--axis",
                        "shadow_map.resolution=64,128", "--out", out, "--quiet"}));
    return out;
}

TEST(CapturedProcess, GivesStatusAndBothStreams)
{
    // More than a pipe holds, on both streams.
    const auto ending = cli::run_captured(
        {"/bin/sh", "-c", "head -c 300000 /dev/zero; head -c 300000 /dev/zero >&2; exit 7"});
    EXPECT_EQ(ending.status, 7);
    EXPECT_EQ(ending.out.size(), 300000U);
    EXPECT_EQ(ending.err.size(), 300000U);
}

TEST(CapturedProcess, TellsASignalFromAStatus)
{
    EXPECT_EQ(cli::run_captured({"/bin/sh", "-c", "kill -KILL $$"}).status, 128 + SIGKILL);
}

TEST(CapturedProcess, HandsArgumentsOverAsTheyAre)
{
    const std::string odd = "a b\n'\"$(id) \\ *";
    EXPECT_EQ(cli::run_captured({"/bin/sh", "-c", "printf %s \"$1\"", "sh", odd}).out, odd);
}

TEST(CapturedProcess, ThrowsWhereTheProgramCannotBeStarted)
{
    EXPECT_THROW((void)cli::run_captured({"/nowhere/program"}), scene::EnvironmentError);
}

TEST(FigureCommand, ListsEveryFigure)
{
    const Ending list = gnomon({"figure", "--list"});
    expect_done(list);
    for (const cli::FigureKind& kind : cli::figure_kinds()) {
        EXPECT_THAT(list.out, HasSubstr(std::string{kind.name} + " "));
    }
}

TEST(FigureCommand, RefusesWrongUsageInOneLine)
{
    expect_refused(gnomon({"figure"}), 2, "no name given; `gnomon figure --list` lists them");
    expect_refused(gnomon({"figure", "pie", "run"}), 2, "unknown figure \"pie\"");
    expect_refused(gnomon({"figure", "pareto"}), 2, "no input given");
    expect_refused(gnomon({"figure", "pareto", "run"}), 2, "no output file given");
    expect_refused(gnomon({"figure", "pareto", "run", "-o", "f.gif"}), 2, "is written as .pdf");
}

TEST(FigureCommand, WritesPdfSvgAndPng)
{
    if (!can_draw()) {
        GTEST_SKIP() << "python3-matplotlib or python3-pandas is not installed";
    }
    const TemporaryFolder folder;
    const std::string sweep = small_run(folder);
    for (const auto& [kind, magic] :
         {std::pair{"pdf", "%PDF"}, std::pair{"svg", "<?xml"}, std::pair{"png", "\x89PNG"}}) {
        if (!tests::runs_full_tests() && std::string_view{kind} != "pdf") {
            continue; // the usual lane draws the others for runs
        }
        const auto file = folder.path() / fmt::format("f.{}", kind);
        expect_done(gnomon({"figure", "error-vs-z", sweep, "-o", file}));
        EXPECT_THAT(text_of(file), StartsWith(magic));
    }
    expect_refused(gnomon({"figure", "pareto", sweep, "-o", folder.path() / "none" / "f.svg"}), 4,
                   "No such file or directory");
}

TEST(DrawRunFigures, WritesWhatItNames)
{
    if (!can_draw()) {
        GTEST_SKIP() << "python3-matplotlib or python3-pandas is not installed";
    }
    const TemporaryFolder folder;
    const auto out = folder.path() / "a" / "figures";
    std::vector<std::string> names;
    for (const FigureFile& figure : cli::draw_run_figures(small_run(folder), out)) {
        names.push_back(figure.name);
        EXPECT_THAT(text_of(out / figure.svg), StartsWith("<?xml"));
        EXPECT_THAT(text_of(out / figure.png), StartsWith("\x89PNG"));
        EXPECT_THAT(figure.caption, HasSubstr("sphere-plane"));
        EXPECT_FALSE(figure.alt.empty() || figure.title.empty()) << figure.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"bias-curve", "errors-vs-z", "depth-error-vs-z",
                                               "causes", "error-vs-axis", "heat-map", "pareto"}));
}

TEST(DrawRunFigures, SaysWhatToInstall)
{
    const TemporaryFolder folder;
    const std::string bare =
        folder.write("python3", "#!/bin/sh\nexec /usr/bin/python3 -S \"$@\"\n");
    std::filesystem::permissions(bare, std::filesystem::perms::owner_all);
    for (const std::string& python : {std::string{"/nowhere/python3"}, bare}) {
        try {
            (void)cli::draw_run_figures(folder.path(), folder.path() / "figures", python);
            ADD_FAILURE() << python << " drew";
        } catch (const cli::PythonMissing& error) {
            EXPECT_THAT(error.what(),
                        HasSubstr("apt-get install python3-matplotlib python3-pandas"));
            EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
        }
    }
}

/// Waits up to ten seconds.
template <typename Condition>
bool comes_true(Condition condition)
{
    for (int i = 0; i < 1000 && !condition(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return condition();
}

TEST(FigureCommand, TakesPythonWithItWhenItIsEnded)
{
    if (!can_draw()) {
        GTEST_SKIP() << "python3-matplotlib or python3-pandas is not installed";
    }
    const TemporaryFolder folder;
    const std::string results = folder.path() / "results.csv";
    ASSERT_EQ(::mkfifo(results.c_str(), 0600), 0);
    int writer = -1; // opens once Python reads; Python then waits for more
    const auto is_read = [&] {
        return (writer = ::open(results.c_str(), O_WRONLY | O_NONBLOCK)) >= 0;
    };
    Start start;
    start.while_running = [&](pid_t program) {
        EXPECT_TRUE(comes_true([&] { return writer >= 0 || is_read(); }));
        ::kill(program, SIGTERM);
    };
    const Ending ending =
        gnomon({"figure", "pareto", folder.path().string(), "-o", folder.path() / "f.svg"}, start);
    EXPECT_EQ(ending.exit_code, 128 + SIGTERM);
    // Python has ended: writing to the pipe fails.
    std::signal(SIGPIPE, SIG_IGN);
    EXPECT_TRUE(comes_true([&] { return ::write(writer, "x", 1) < 0; }));
    ::close(writer);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "f.svg"));
}

} // namespace
} // namespace gnomon::testing
