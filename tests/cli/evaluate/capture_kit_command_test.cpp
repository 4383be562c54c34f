#include "child_process.hpp"

#include "cli/evaluate/capture_kit_command.hpp"
#include "run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;

TEST(CaptureKit, WritesEveryFileAsItIsInTheSource)
{
    const TemporaryFolder folder;
    const std::filesystem::path kit = folder.path() / "made" / "kit";
    const Ending ending = gnomon({"capture-kit", kit.string()});
    expect_done(ending);
    for (const cli::KitFile& file : cli::capture_kit_files()) {
        EXPECT_EQ(text_of(kit / file.name), file.text);
        EXPECT_THAT(ending.out, HasSubstr((kit / file.name).string() + "\n"));
    }
    for (const char* name : {"case.toml", "gnomon_capture.glsl", "gnomon_capture.hlsl",
                             "pack_aov.py", "bring_your_own_renderer.md"}) {
        EXPECT_TRUE(std::filesystem::exists(kit / name)) << name;
    }
}

TEST(CaptureKit, ReplacesNothingUnlessForced)
{
    const TemporaryFolder folder;
    folder.write("case.toml", "mine");
    expect_refused(gnomon({"capture-kit", folder.path().string()}), 2,
                   (folder.path() / "case.toml").string() + ": the file exists");
    EXPECT_EQ(text_of(folder.path() / "case.toml"), "mine");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "pack_aov.py"));
    expect_done(gnomon({"capture-kit", folder.path().string(), "--force"}));
    EXPECT_NE(text_of(folder.path() / "case.toml"), "mine");
}

TEST(CaptureKit, SaysWhereItCannotWrite)
{
    const TemporaryFolder folder;
    folder.write("file", "");
    expect_refused(gnomon({"capture-kit", (folder.path() / "file" / "kit").string()}), 4,
                   "the folder cannot be created");
}

} // namespace
} // namespace gnomon::testing
