// `gnomon sweep` killed, interrupted, and on a full disk.

#include "child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::HasSubstr;

/// A sweep that is killed and resumed any number of times has the results of an uninterrupted one.
void expect_resumed(const std::vector<std::string>& axes)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    std::mt19937 random{7};
    // With and without pixels: a recorded result includes its pixels.
    for (const char* const pixels : {"--keep-pixels", "--no-keep-pixels"}) {
        SCOPED_TRACE(pixels);
        const path whole = folder.path() / "whole";
        const Ending ending = swept(sweep(job, whole, with(axes, {pixels})));
        const path run = folder.path() / "run";
        const int kills = tests::in_lane(2, 20);
        std::string moments;
        int killed = 0;
        // A kill after the end does not count. A finished run resumes too fast to be killed, so it
        // starts again.
        for (int tries = 0; killed < kills && tries < 10 * kills; ++tries) {
            const auto moment_ms =
                static_cast<int>(random() % static_cast<std::uint64_t>(1 + 800 * ending.time_s));
            moments += fmt::format(" {}", moment_ms);
            Start start;
            start.while_running = [&](pid_t child) {
                std::this_thread::sleep_for(std::chrono::milliseconds{moment_ms});
                ::kill(child, SIGKILL);
            };
            const Ending tried = gnomon(sweep(job, run, with(axes, {pixels})), start);
            if (tried.signal == SIGKILL) {
                ++killed;
            } else {
                ASSERT_EQ(tried.exit_code, 0) << tried.err;
                expect_same(RunCsv{run}, RunCsv{whole});
                std::filesystem::remove_all(run);
            }
        }
        SCOPED_TRACE(fmt::format("killed {} times, after{} ms", killed, moments));
        ASSERT_EQ(killed, kills);
        swept(sweep(job, run, with(axes, {pixels})));
        expect_same(RunCsv{run}, RunCsv{whole});
        EXPECT_EQ(kept_images(run), kept_images(whole));
        std::filesystem::remove_all(run);
        std::filesystem::remove_all(whole);
    }
}

TEST(Sweep, ResumesWheneverItIsKilled)
{
    expect_resumed(
        {"--axis",
         tests::in_lane("shadow_map.resolution=16,24", "shadow_map.resolution=16,20,24,28,32"),
         "--axis", "lookup.filter=nearest,hardware", "--axis", "bias.constant=0,0.001,0.02"});
}

TEST(Sweep, ResumesAmongWhatAMethodMakesOfAMap)
{
    expect_resumed({"--set", "method.name=vsm", "--axis",
                    tests::in_lane("shadow_map.resolution=24", "shadow_map.resolution=16,24"),
                    "--axis", "method.kernel_width=1,5", "--axis",
                    "method.bleeding_reduction=0,0.2", "--axis",
                    tests::in_lane("bias.constant=0,0.02", "bias.constant=0,0.001,0.02")});
}

/// A sweep that keeps pixels, so that its progress is visible from outside.
std::vector<std::string> slow_sweep(const path& job, const path& run)
{
    return sweep(job, run,
                 {"--keep-pixels", "--axis", "shadow_map.resolution=16,20,24", "--axis",
                  "bias.constant=0,0.001,0.02,0.05"});
}

/// Waits until the run's first configuration is kept.
void wait_for_pixels(const path& run)
{
    wait_until([&] { return kept_images(run) > 0; });
}

TEST(Sweep, FinishesWhatHasBegunWhenItIsInterrupted)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path whole = folder.path() / "whole";
    swept(slow_sweep(job, whole));
    const path run = folder.path() / "run";
    Start start;
    start.while_running = [&](pid_t child) {
        wait_for_pixels(run);
        ::kill(child, SIGINT);
    };
    const Ending interrupted = gnomon(slow_sweep(job, run), start);
    EXPECT_EQ(interrupted.exit_code, 130) << interrupted.err;
    EXPECT_THAT(interrupted.err, HasSubstr("gnomon: interrupted; finishing what has begun"));
    EXPECT_THAT(interrupted.err, HasSubstr("the same command goes on where this stopped"));
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 24U);
    const auto done = static_cast<std::size_t>(std::count_if(
        rows.begin(), rows.end(), [](const auto& row) { return row.at("status") == "done"; }));
    EXPECT_GE(done, 1U);
    EXPECT_LT(done, 24U);
    EXPECT_EQ(kept_images(run), done) << "what has begun is kept and recorded";
    EXPECT_EQ(gnomon({"status", run}).exit_code, incomplete);
    const Ending rest = swept(slow_sweep(job, run));
    EXPECT_THAT(rest.err, HasSubstr("24/24 done"));
    expect_same(RunCsv{run}, RunCsv{whole});
}

TEST(Sweep, RefusesARunThatAnotherOneWrites)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    Start start;
    start.while_running = [&](pid_t child) {
        wait_for_pixels(run);
        ::kill(child, SIGSTOP);
        const Ending second = gnomon(slow_sweep(job, run));
        ::kill(child, SIGCONT);
        expect_refused(second, 2, "another process is writing here (process ");
        EXPECT_THAT(second.err, HasSubstr(fmt::format("process {} on ", child)));
        EXPECT_THAT(second.err, HasSubstr(job.string())) << "its command is named";
    };
    swept(slow_sweep(job, run), start);
}

/// Makes the user the owner of all files in the run.
void give_to(const path& place, unsigned user)
{
    EXPECT_EQ(::chown(place.c_str(), user, user), 0);
    EXPECT_EQ(::chmod(place.c_str(), 0755), 0);
}

TEST(Sweep, ResumesWhenItsFolderMayBeWrittenAgain)
{
    if (::geteuid() != 0) {
        GTEST_SKIP() << "needs root, to run the program as somebody whom a folder can refuse";
    }
    constexpr unsigned nobody = 65534;
    const TemporaryFolder folder;
    give_to(folder.path(), nobody);
    const path job = folder.write("job.toml", two_lights);
    Start start;
    start.user_id = nobody;
    start.environment = {"HOME=" + folder.path().string()};
    const path whole = folder.path() / "whole";
    if (gnomon(slow_sweep(job, whole), start).exit_code == 126 + 1) {
        GTEST_SKIP() << "the program is not where another user may run it";
    }
    // Writing fails in the pixels' folder in mid-run, or in the CSV files' folder at the end.
    for (const char* const refusing : {"pixels", "."}) {
        SCOPED_TRACE(refusing);
        const path run = folder.path() / "run";
        start.while_running = [&](pid_t child) {
            wait_for_pixels(run);
            ::kill(child, SIGSTOP);
            EXPECT_EQ(::chmod((run / refusing).c_str(), 0555), 0);
            ::kill(child, SIGCONT);
        };
        const Ending refused = gnomon(with(slow_sweep(job, run), {"--quiet"}), start);
        expect_refused(refused, 4, "cannot write");
        EXPECT_EQ(::chmod((run / refusing).c_str(), 0755), 0);
        start.while_running = {};
        swept(slow_sweep(job, run), start);
        expect_same(RunCsv{run}, RunCsv{whole});
        std::filesystem::remove_all(run);
    }
}

/// A small disk.
class Disk {
public:
    Disk(path folder, int size_kib) : folder_{std::move(folder)}
    {
        std::filesystem::create_directories(folder_);
        is_mounted_ = ::mount("none", folder_.c_str(), "tmpfs", 0,
                              fmt::format("size={}k", size_kib).c_str()) == 0;
    }
    Disk(const Disk&) = delete;
    Disk& operator=(const Disk&) = delete;
    ~Disk()
    {
        if (is_mounted_) {
            ::umount(folder_.c_str());
        }
    }
    [[nodiscard]] bool is_mounted() const { return is_mounted_; }
    void resize(int size_kib) const
    {
        EXPECT_EQ(::mount("none", folder_.c_str(), "tmpfs", MS_REMOUNT,
                          fmt::format("size={}k", size_kib).c_str()),
                  0);
    }

private:
    path folder_;
    bool is_mounted_ = false;
};

TEST(Sweep, ResumesWhenADiskHasRoomAgain)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path whole = folder.path() / "whole";
    swept(slow_sweep(job, whole));
    int refusals = 0;
    for (const int size_kib : tests::in_lane<std::vector<int>>({16, 600}, {16, 300, 600})) {
        SCOPED_TRACE(fmt::format("{} KiB", size_kib));
        const Disk disk{folder.path() / "disk", size_kib};
        if (!disk.is_mounted()) {
            GTEST_SKIP() << "no right to mount a small disk";
        }
        const path run = folder.path() / "disk" / "run";
        const Ending full = gnomon(with(slow_sweep(job, run), {"--quiet"}));
        if (full.exit_code != 0) {
            expect_refused(full, 4, "make room");
            ++refusals;
        }
        disk.resize(64 * 1024);
        swept(slow_sweep(job, run));
        expect_same(RunCsv{run}, RunCsv{whole});
        EXPECT_EQ(kept_images(run), 24U);
    }
    EXPECT_GE(refusals, tests::in_lane(1, 2)) << "the disks are too large to say anything";
}

TEST(Sweep, ResumesWhenItsFilesMayGrowAgain)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const std::vector<std::string> axes{"--axis", "shadow_map.resolution=16,20,24,28,32", "--quiet",
                                        "--no-keep-pixels"};
    const path whole = folder.path() / "whole";
    swept(sweep(job, whole, axes));
    const path run = folder.path() / "run";
    Start start;
    // Room for a database without results, and for half of the largest CSV file.
    start.file_bytes = std::filesystem::file_size(whole / "bias_curves.csv") / 2;
    expect_refused(gnomon(sweep(job, run, axes), start), 4, "make room");
    swept(sweep(job, run, axes));
    expect_same(RunCsv{run}, RunCsv{whole});
}

} // namespace
} // namespace gnomon::testing
