#include "child_process.hpp"

#include "api/memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::StartsWith;

std::vector<std::string> entries(const path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{folder}) {
        names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> small_comparison(const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments = small({"compare", "--builtin", "sphere-cube"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Output, GoesToTheNamedFiles)
{
    const TemporaryFolder folder;
    const path aov = folder.path() / "a.exr";
    const path picture = folder.path() / "p.png";
    const path map = folder.path() / "m.exr";
    expect_done(gnomon(small_comparison({"--aov", aov, "--picture", picture, "--depth-map", map})));
    EXPECT_EQ(entries(folder.path()), (std::vector<std::string>{"a.exr", "m.exr", "p.png"}));
    EXPECT_THAT(text_of(map), StartsWith("\x76\x2f\x31\x01"));
    EXPECT_THAT(text_of(aov), StartsWith("\x76\x2f\x31\x01"));
    EXPECT_THAT(text_of(picture), StartsWith("\x89PNG"));
}

TEST(Output, ThatCannotBeWrittenIsRefusedBeforeTheWork)
{
    // Without EGL the message would differ.
    Start start;
    start.environment = {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent"};
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "text");
    const std::string place = folder.path();
    for (const char* const option : {"--aov", "--picture", "--depth-map", "--view-depths"}) {
        for (const std::string& target :
             {place, place + "/none/a", file + "/a", std::string{"/proc/self/a"}}) {
            expect_refused(gnomon(small_comparison({option, target}), start), 4,
                           "cannot write " + target);
        }
    }
    EXPECT_EQ(entries(folder.path()), std::vector<std::string>{"file"});
}

TEST(Output, DoesNotReplaceTheJobOrTheOtherOutput)
{
    const TemporaryFolder folder;
    const std::string job = folder.write("job.toml", "[scene]\nbuiltin = \"wall\"\n");
    const std::string place = folder.path();
    expect_refused(gnomon({"compare", job, "--picture", place + "/./job.toml"}), 2,
                   "is both JOB and output");
    expect_refused(gnomon({"compare", job, "--aov", place + "/a", "--picture", place + "//a"}), 2,
                   "--aov and --picture name the same file");
    expect_refused(gnomon({"compare", job, "--picture", place + "/a", "--depth-map", place + "/a"}),
                   2, "--picture and --depth-map name the same file");
    EXPECT_EQ(entries(folder.path()), std::vector<std::string>{"job.toml"});
}

/// A disk of 64 KiB.
class SmallDisk {
public:
    explicit SmallDisk(path folder) : folder_{std::move(folder)}
    {
        is_mounted_ = ::mount("none", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk()
    {
        if (is_mounted_) {
            ::umount(folder_.c_str());
        }
    }
    [[nodiscard]] bool is_mounted() const { return is_mounted_; }

private:
    path folder_;
    bool is_mounted_ = false;
};

TEST(Output, OnAFullDiskLeavesTheOldFileAndNoHalfOne)
{
    const TemporaryFolder folder;
    const SmallDisk disk{folder.path()};
    if (!disk.is_mounted()) {
        GTEST_SKIP() << "mounting a small disk needs root: " << std::strerror(errno);
    }
    const std::string old = folder.write("old", "old");
    for (const char* const option : {"--aov", "--picture", "--depth-map"}) {
        expect_refused(gnomon({"compare", "--builtin", "sphere-cube", "--set", "image.width=640",
                               "--set", "image.height=360", option, old}),
                       4, "No space left on device");
    }
    EXPECT_EQ(entries(folder.path()), std::vector<std::string>{"old"});
    EXPECT_EQ(text_of(old), "old");
}

TEST(Output, OnAFullDeviceFails)
{
    for (const char* const option : {"--aov", "--picture", "--depth-map", "--view-depths"}) {
        expect_refused(gnomon(small_comparison({option, "/dev/full"})), 4,
                       "cannot write /dev/full: write: No space left on device");
    }
    expect_refused(gnomon({"init", "--force", "/dev/full"}), 4, "No space left on device");
}

std::vector<std::vector<std::string>> commands_that_print()
{
    return {small_comparison(),
            small_comparison({"--json"}),
            {"scenes"},
            {"scenes", "--json"},
            {"methods"},
            {"methods", "--json"},
            {"init"},
            {"doctor"},
            {"depth", "--samples", "16", "--csv"},
            {"completion", "bash"},
            {"--help"},
            {"--version"},
            {"compare", "--help"}};
}

TEST(StandardOutput, ThatIsFullFails)
{
    Start start;
    start.stdout_path = "/dev/full";
    for (const auto& command : commands_that_print()) {
        expect_refused(gnomon(command, start), 4, "standard output: No space left on device");
    }
}

TEST(StandardOutput, ThatIsClosedFails)
{
    Start start;
    start.closes_stdout = true;
    for (const auto& command : commands_that_print()) {
        expect_refused(gnomon(command, start), 4, "standard output: Bad file descriptor");
    }
}

TEST(StandardOutput, ThatNobodyReadsEndsTheProgramQuietly)
{
    Start start;
    start.breaks_stdout = true;
    for (const auto& command : commands_that_print()) {
        const Ending ending = gnomon(command, start);
        EXPECT_EQ(ending.exit_code, 4) << ending.command;
        EXPECT_EQ(ending.err, "") << ending.command;
    }
}

TEST(StandardOutput, ThatIsClosedDoesNotEndUpInAFile)
{
    // Otherwise the first file opened would get stdout's number.
    const TemporaryFolder folder;
    const path closed = folder.path() / "closed.exr";
    const path open = folder.path() / "open.exr";
    Start start;
    start.closes_stdout = true;
    expect_refused(gnomon(small_comparison({"--json", "--aov", closed}), start), 4,
                   "standard output");
    expect_done(gnomon(small_comparison({"--json", "--aov", open})));
    EXPECT_EQ(text_of(closed).size(), text_of(open).size());
}

TEST(Memory, NeedGrowsWithImageAndMap)
{
    scene::Job job;
    job.image = {16000, 8000};
    const std::uint64_t large = api::needed_memory_bytes(job);
    // Its verdicts, depths and triangles alone are 4 bytes each.
    EXPECT_GT(large, 16000ULL * 8000 * 12);
    job.shadow_map.resolution_texels = 16384;
    const std::uint64_t with_map = api::needed_memory_bytes(job);
    EXPECT_EQ(with_map, large + (16384ULL * 16384 - 1024ULL * 1024) * 4);
    // A lookup needs no codes, so a u-format keeps none.
    job.shadow_map.depth_format = {scene::DepthFormat::Kind::unorm, 24};
    EXPECT_EQ(api::needed_memory_bytes(job), with_map);
    // A colour format needs a depth buffer too.
    job.shadow_map.depth_format = {scene::DepthFormat::Kind::rgba8, 32};
    EXPECT_EQ(api::needed_memory_bytes(job), with_map + 16384ULL * 16384 * 4);
    EXPECT_GT(api::available_memory_bytes(), 0U);
}

} // namespace
} // namespace gnomon::testing
