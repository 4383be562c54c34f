#include "store/output_file.hpp"

#include "example_comparison.hpp"
#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace gnomon::store {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// The one-line message of the EnvironmentError that writing raises.
std::string error_of_writing(const std::filesystem::path& path, std::string_view text = "text")
{
    try {
        write_file(path, text);
    } catch (const scene::EnvironmentError& error) {
        return error.what();
    }
    return "no error";
}

TEST(OutputFile, AppearsWholeWhenCommitted)
{
    const TemporaryFolder folder;
    OutputFile file{folder / "a.csv"};
    file.write("one,");
    file.write("two\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.csv"));
    file.commit();
    EXPECT_EQ(read_text(folder / "a.csv"), "one,two\n");
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(OutputFile, ReplacesWhatStoodThere)
{
    const TemporaryFolder folder;
    write_file(folder / "a.json", "a longer old text");
    write_file(folder / "a.json", "new");
    EXPECT_EQ(read_text(folder / "a.json"), "new");
}

TEST(OutputFile, LeavesNothingBehindWithoutCommit)
{
    const TemporaryFolder folder;
    write_file(folder / "a.csv", "old");
    {
        OutputFile file{folder / "a.csv"};
        file.write("new");
    }
    EXPECT_EQ(read_text(folder / "a.csv"), "old");
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(OutputFile, KnowsWhatItsTemporaryFilesAreFor)
{
    const TemporaryFolder folder;
    for (const char* const name : {"a.csv", "a", ".a", "a.1-2.tmp"}) {
        const OutputFile file{folder / name};
        const auto temporary = std::filesystem::directory_iterator
        {
            folder.path()
            } -> path();
        EXPECT_EQ(temporary_target(temporary.filename().string()), name);
    }
    EXPECT_EQ(temporary_target(".a.csv.4711-0.tmp"), "a.csv");
    for (const char* const name :
         {"", ".", ".tmp", "a.csv", "a.csv.4711-0.tmp", ".a.csv.4711-0", ".a.csv.4711-.tmp",
          ".a.csv.-0.tmp", ".a.csv-0.tmp", ".4711-0.tmp", "..4711-0.tmp"}) {
        EXPECT_EQ(temporary_target(name), "") << name;
    }
}

TEST(OutputFile, LetsTwoWritersOfOnePathFinish)
{
    const TemporaryFolder folder;
    OutputFile first{folder / "a.csv"};
    OutputFile second{folder / "a.csv"};
    first.write("first");
    second.write("second");
    second.commit();
    first.commit();
    EXPECT_EQ(read_text(folder / "a.csv"), "first");
}

TEST(OutputFile, HonoursTheUmask)
{
    const TemporaryFolder folder;
    const mode_t before = ::umask(027);
    write_file(folder / "a.csv", "text");
    ::umask(before);
    struct stat status {};
    ASSERT_EQ(::stat((folder / "a.csv").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(OutputFile, FollowsASymbolicLink)
{
    const TemporaryFolder folder;
    write_file(folder / "target", "old");
    std::filesystem::create_symlink("target", folder / "link");
    write_file(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(read_text(folder / "target"), "new");
}

TEST(OutputFile, WritesADeviceDirectly)
{
    EXPECT_NO_THROW(write_file("/dev/null", "text"));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, ReportsAFullDevice)
{
    EXPECT_THAT(error_of_writing("/dev/full"),
                AllOf(HasSubstr("cannot write /dev/full: write: No space left on device"),
                      HasSubstr("make room"), Not(HasSubstr("\n"))));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

/// Limits the size of this process's files, like a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        (void)std::signal(SIGXFSZ, signal_before_);
    }

private:
    rlimit before_{};
    void (*signal_before_)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

TEST(OutputFile, KeepsTheOldFileWhenTheDiskIsFull)
{
    const TemporaryFolder folder;
    write_file(folder / "a.json", "old");
    std::string message;
    {
        const FileSizeLimit limit{4096};
        message = error_of_writing(folder / "a.json", std::string(100'000, 'x'));
    }
    EXPECT_THAT(message, AllOf(HasSubstr("write: File too large"), HasSubstr("make room")));
    EXPECT_EQ(read_text(folder / "a.json"), "old");
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(OutputFile, NamesAMissingFolder)
{
    const TemporaryFolder folder;
    EXPECT_THAT(error_of_writing(folder / "none/a.json"),
                AllOf(HasSubstr((folder / "none/a.json").string()),
                      HasSubstr("No such file or directory"), HasSubstr("create the folder")));
}

TEST(OutputFile, RefusesAFolder)
{
    const TemporaryFolder folder;
    EXPECT_THAT(error_of_writing(folder.path()),
                AllOf(HasSubstr("Is a directory"), HasSubstr("name a file in that folder")));
}

TEST(OutputFile, RefusesAFolderThatMayNotBeWritten)
{
    // Not even root can write to /proc.
    EXPECT_THAT(error_of_writing("/proc/self/a.json"), HasSubstr("cannot write /proc/self/a.json"));
}

void expect_refusal(const char* path, OutputKind kind, const char* text)
{
    EXPECT_THAT([&] { require_output_name(path, kind); },
                ThrowsMessage<scene::InputError>(HasSubstr(text)))
        << path;
}

TEST(OutputName, MayHaveTheEndingOfWhatIsWritten)
{
    EXPECT_NO_THROW(require_output_name("a.png", OutputKind::picture));
    EXPECT_NO_THROW(require_output_name("a.b.exr", OutputKind::layers));
    EXPECT_NO_THROW(require_output_name("a.svg", OutputKind::plot));
    EXPECT_NO_THROW(require_output_name("a.png", OutputKind::plot));
    EXPECT_NO_THROW(require_output_name("a.pdf", OutputKind::figure));
    EXPECT_NO_THROW(require_output_name("a.toml", OutputKind::job));
}

TEST(OutputName, MayHaveNoEndingWhereTheFormatDoesNotDependOnIt)
{
    for (const OutputKind kind : {OutputKind::picture, OutputKind::layers, OutputKind::csv,
                                  OutputKind::junit, OutputKind::baseline, OutputKind::job}) {
        EXPECT_NO_THROW(require_output_name("/dev/stdout", kind));
    }
    expect_refusal("/dev/stdout", OutputKind::plot,
                   "/dev/stdout: a plot is written as .svg or .png");
    expect_refusal("a", OutputKind::figure, "a: a figure is written as .pdf, .svg or .png");
}

TEST(OutputName, OfATextMayHaveAnyEndingThatIsNoOthers)
{
    EXPECT_NO_THROW(require_output_name("a.txt", OutputKind::csv));
    EXPECT_NO_THROW(require_output_name("a.v2", OutputKind::baseline));
    expect_refusal("a.png", OutputKind::csv, "a.png: a table is written as .csv; name it so");
    expect_refusal("a.toml", OutputKind::baseline, "a.toml: a baseline is written as .json");
    expect_refusal("a.json", OutputKind::junit, "a.json: a JUnit report is written as .xml");
    expect_refusal("model.glb", OutputKind::csv, "is written as .csv");
}

TEST(OutputName, OfAnImageMayHaveNoOtherEnding)
{
    expect_refusal("x.jpg", OutputKind::picture, "x.jpg: a picture is written as .png; name it so");
    expect_refusal("x.exr", OutputKind::picture, "is written as .png");
    expect_refusal("x.png", OutputKind::layers, "x.png: an image of numbers is written as .exr");
    expect_refusal("x.unknown", OutputKind::layers, "is written as .exr");
    expect_refusal("x.json", OutputKind::job, "x.json: a job file is written as .toml");
}

} // namespace
} // namespace gnomon::store
