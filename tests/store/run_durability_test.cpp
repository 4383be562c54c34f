#include "store/run/run_store.hpp"

#include "child.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <string>
#include <thread>

namespace gnomon::store {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Access = RunStore::Access;

const ExampleRun durable_run{40, 25};

/// The CSV files of an undisturbed run.
const std::string& undisturbed_csv()
{
    static const std::string texts = [] {
        const TemporaryFolder folder;
        durable_run.compute(folder.path());
        return csv_texts(folder.path());
    }();
    return texts;
}

/// Records the missing results, like a resumed sweep.
void resume(const std::filesystem::path& folder, const std::function<void(std::uint64_t)>& done)
{
    RunStore store{folder, Access::write};
    store.plan(durable_run.description(), durable_run.configurations());
    std::set<std::uint64_t> curves;
    for (const std::uint64_t ordinal : store.ordinals(RunState::planned)) {
        curves.insert(ordinal / durable_run.biases);
    }
    for (const std::uint64_t curve : curves) {
        store.record(durable_run.curve(curve));
        done(curve);
    }
    store.write_csv();
}

TEST(RunDurability, KeepsWhatWasReportedWhenItIsKilled)
{
    const TemporaryFolder folder;
    const auto log = folder / "reported";
    std::mt19937 random{5};
    for (int kills = 0; kills < 20; ++kills) {
        Child child{[&](const Child::Ready& ready) {
            const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
            ready();
            resume(folder.path(), [&](std::uint64_t curve) {
                const auto byte = static_cast<char>(curve);
                [[maybe_unused]] const ssize_t written = ::write(file, &byte, 1);
            });
        }};
        std::this_thread::sleep_for(std::chrono::microseconds{random() % 40'000});
        child.kill();
        if (std::filesystem::exists(folder / "results.sqlite")) {
            const RunStore store{folder.path(), Access::write};
            const auto done = store.ordinals(RunState::done);
            for (const char curve : read_text(log)) {
                const auto ordinal = static_cast<std::uint64_t>(curve) * durable_run.biases;
                EXPECT_TRUE(std::binary_search(done.begin(), done.end(), ordinal))
                    << "after kill " << kills << ", curve " << int{curve};
            }
            EXPECT_EQ(done.size() % durable_run.biases, 0U) << "half a curve after kill " << kills;
        }
    }
    resume(folder.path(), [](std::uint64_t) {});
    EXPECT_EQ(csv_texts(folder.path()), undisturbed_csv());
    std::string reported = read_text(log);
    std::sort(reported.begin(), reported.end());
    EXPECT_EQ(std::adjacent_find(reported.begin(), reported.end()), reported.end())
        << "a curve was computed twice";
}

/// The error of a function that runs in a child process.
std::string error_in_child(const std::function<void()>& work)
{
    const TemporaryFolder folder;
    const auto file = folder / "message";
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT, 0666);
    Child child{[&](const Child::Ready&) {
        std::string message = "no error";
        try {
            work();
        } catch (const scene::EnvironmentError& error) {
            message = std::string{"EnvironmentError: "} + error.what();
        } catch (const scene::InputError& error) {
            message = std::string{"InputError: "} + error.what();
        }
        [[maybe_unused]] const ssize_t written =
            ::write(descriptor, message.data(), message.size());
    }};
    EXPECT_EQ(child.exit_code(), 0);
    ::close(descriptor);
    return read_text(file);
}

/// Limits the size of this process's files, like a full disk.
void limit_files(rlim_t bytes)
{
    (void)std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
}

TEST(RunDurability, ResumesWhenThereIsRoomAgain)
{
    const TemporaryFolder folder;
    for (const rlim_t bytes : {100'000U, 300'000U, 400'000U, 600'000U}) {
        const std::string message = error_in_child([&] {
            limit_files(bytes);
            resume(folder.path(), [](std::uint64_t) {});
        });
        EXPECT_THAT(message, AllOf(HasSubstr("EnvironmentError: "),
                                   HasSubstr(folder.path().string()), HasSubstr("make room"),
                                   HasSubstr("run the same command again"), Not(HasSubstr("\n"))))
            << bytes << " bytes";
    }
    resume(folder.path(), [](std::uint64_t) {});
    EXPECT_EQ(csv_texts(folder.path()), undisturbed_csv());
}

TEST(RunDurability, SaysThatTheDiskIsFullWhenTheCsvFilesDoNotFit)
{
    const TemporaryFolder folder;
    const ExampleRun small{2, 2000};
    small.compute(folder.path());
    const std::string before = csv_texts(folder.path());
    const std::string message = error_in_child([&] {
        RunStore store{folder.path(), Access::write};
        limit_files(100'000);
        store.write_csv();
    });
    EXPECT_THAT(message, AllOf(HasSubstr("results.csv"), HasSubstr("make room")));
    EXPECT_EQ(csv_texts(folder.path()), before);
}

/// Whether this is root, who may write everywhere.
void become_nobody()
{
    constexpr uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setresuid(nobody, nobody, nobody) != 0) {
        ::_exit(3);
    }
}

/// Forbids or allows writing in a folder.
void set_writable(const std::filesystem::path& folder, bool is_writable)
{
    using std::filesystem::perms;
    const perms writing = perms::owner_write | perms::group_write | perms::others_write;
    for (const auto& entry : std::filesystem::directory_iterator{folder}) {
        std::filesystem::permissions(entry, is_writable ? perms::all : perms::all & ~writing);
    }
    std::filesystem::permissions(folder, is_writable ? perms::all : perms::all & ~writing);
}

TEST(RunDurability, SaysThatTheFolderMayNotBeWritten)
{
    const TemporaryFolder folder;
    durable_run.compute(folder.path());
    set_writable(folder.path(), false);
    const std::string message = error_in_child([&] {
        become_nobody();
        RunStore store{folder.path(), Access::write};
        store.plan(durable_run.description(), durable_run.configurations());
    });
    set_writable(folder.path(), true);
    EXPECT_THAT(message, AllOf(HasSubstr("EnvironmentError: "), HasSubstr("results.sqlite"),
                               HasSubstr("make the folder writable"), Not(HasSubstr("\n"))));
    EXPECT_EQ(csv_texts(folder.path()), undisturbed_csv());
}

TEST(RunDurability, SaysThatANewFolderMayNotBeWritten)
{
    const TemporaryFolder folder;
    set_writable(folder.path(), false);
    const std::string message = error_in_child([&] {
        become_nobody();
        const RunStore store{folder.path(), Access::write};
    });
    set_writable(folder.path(), true);
    EXPECT_THAT(message, AllOf(HasSubstr("EnvironmentError: "), HasSubstr("results.sqlite"),
                               HasSubstr("make the folder writable")));
}

TEST(RunDurability, IsReadWhereNothingMayBeWritten)
{
    const TemporaryFolder folder;
    durable_run.compute(folder.path());
    set_writable(folder.path(), false);
    const std::string message = error_in_child([&] {
        become_nobody();
        const RunStore store{folder.path(), Access::read};
        if (store.ordinals(RunState::done).size() != durable_run.curves * durable_run.biases) {
            throw scene::InputError("not all was read");
        }
    });
    set_writable(folder.path(), true);
    EXPECT_EQ(message, "no error");
}

std::string refusal(const std::filesystem::path& folder, Access access)
{
    try {
        RunStore store{folder, access};
        (void)store.ordinals(RunState::done);
        store.write_csv();
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "accepted";
}

void expect_refused(const std::filesystem::path& folder, const std::string& text)
{
    for (const Access access : {Access::read, Access::write}) {
        EXPECT_THAT(refusal(folder, access), AllOf(HasSubstr("results.sqlite"), HasSubstr(text)));
    }
}

TEST(RunDurability, RefusesAFileThatIsNoDatabase)
{
    const TemporaryFolder folder;
    const std::string text(5000, 'x');
    std::ofstream{folder / "results.sqlite"} << text;
    expect_refused(folder.path(), "is damaged, or not a database of results");
    EXPECT_EQ(read_text(folder / "results.sqlite"), text);
}

TEST(RunDurability, RefusesADatabaseThatIsCutOff)
{
    const TemporaryFolder folder;
    durable_run.compute(folder.path());
    const auto file = folder / "results.sqlite";
    const auto size = std::filesystem::file_size(file);
    for (const std::uintmax_t left : {size - 5000, size / 2, std::uintmax_t{4096}}) {
        std::filesystem::resize_file(file, left);
        expect_refused(folder.path(), "is damaged");
    }
}

TEST(RunDurability, RefusesADamagedDatabase)
{
    const TemporaryFolder folder;
    durable_run.compute(folder.path());
    {
        const auto path = folder / "results.sqlite";
        const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path));
        std::fstream file{path, std::ios::in | std::ios::out | std::ios::binary};
        for (std::streamoff page = 20 * 4096; page < size; page += 4096) {
            file.seekp(page);
            file << "rubbish in the header of a page";
        }
    }
    EXPECT_THAT(refusal(folder.path(), Access::write), HasSubstr("is damaged"));
    EXPECT_THAT(refusal(folder.path(), Access::read), HasSubstr("is damaged"));
}

void run_sql(const std::filesystem::path& file, const char* sql)
{
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
}

TEST(RunDurability, RefusesAnotherProgramsDatabaseAndLeavesItAlone)
{
    const TemporaryFolder folder;
    const auto file = folder / "results.sqlite";
    run_sql(file, "CREATE TABLE bookmarks (url TEXT)");
    const std::string before = read_text(file);
    expect_refused(folder.path(), "not of a sweep's results: name another folder");
    EXPECT_EQ(read_text(file), before);
}

TEST(RunDurability, RefusesAnotherSchema)
{
    const TemporaryFolder folder;
    durable_run.compute(folder.path());
    run_sql(folder / "results.sqlite", "PRAGMA user_version = 99");
    expect_refused(folder.path(), "its schema is 99, this Gnomon's is 2");
}

TEST(RunDurability, RefusesOtherColumns)
{
    const TemporaryFolder folder;
    durable_run.compute(folder.path());
    run_sql(folder / "results.sqlite", "ALTER TABLE configurations ADD COLUMN luck REAL");
    expect_refused(folder.path(), "a Gnomon with other keys or results wrote it");
}

TEST(RunDurability, TakesADatabaseThatWasNeverMade)
{
    const TemporaryFolder folder;
    {
        const std::ofstream empty{folder / "results.sqlite"};
    } // as a kill at the very start leaves it
    resume(folder.path(), [](std::uint64_t) {});
    EXPECT_EQ(csv_texts(folder.path()), undisturbed_csv());
}

} // namespace
} // namespace gnomon::store
