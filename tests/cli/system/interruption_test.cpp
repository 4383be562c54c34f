#include "child_process.hpp"

#include "cli/system/process.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <utility>

namespace gnomon::testing {
namespace {

using std::filesystem::path;

TEST(InterruptionDeathTest, RemovesATemporaryFileAndKeepsTheOldOne)
{
    const TemporaryFolder folder;
    const path old = folder.write("a.json", "old");
    for (const auto& [signal, exit_code] :
         {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}, std::pair{SIGHUP, 129}}) {
        EXPECT_EXIT(
            {
                cli::clean_up_on_signals();
                store::OutputFile committed{folder.path() / "b.json"};
                committed.write("whole");
                committed.commit();
                store::OutputFile half{old};
                half.write("half");
                store::OutputFile other{folder.path() / "c.json"};
                (void)::raise(signal);
            },
            ::testing::ExitedWithCode(exit_code), "gnomon: interrupted");
        const std::filesystem::directory_iterator entries{folder.path()};
        EXPECT_EQ(std::distance(begin(entries), end(entries)), 2) << "signal " << signal;
        EXPECT_EQ(std::filesystem::file_size(old), 3U);
    }
}

/// Sends the signal as soon as the n-th temporary file appears in the folder.
class Interrupter {
public:
    Interrupter(const path& folder, int n) : watch_{::inotify_init1(IN_CLOEXEC)}, n_{n}
    {
        EXPECT_GE(::inotify_add_watch(watch_, folder.c_str(), IN_CREATE), 0);
    }
    Interrupter(const Interrupter&) = delete;
    Interrupter& operator=(const Interrupter&) = delete;
    ~Interrupter() { ::close(watch_); }

    void operator()(pid_t child) const
    {
        constexpr int longest_ms = 30'000;
        alignas(inotify_event) std::array<char, 4096> buffer{};
        int created = 0;
        while (created < n_) {
            pollfd ready{watch_, POLLIN, 0};
            if (::poll(&ready, 1, longest_ms) <= 0) {
                ADD_FAILURE() << "temporary file " << n_ << " did not appear";
                break;
            }
            const ssize_t got = ::read(watch_, buffer.data(), buffer.size());
            for (ssize_t at = 0; at < got; ++created) {
                const auto* event = reinterpret_cast<const inotify_event*>(
                    buffer.data() + static_cast<std::size_t>(at));
                at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            }
        }
        ::kill(child, SIGINT);
    }

private:
    int watch_;
    int n_;
};

TEST(Interruption, LeavesNoTemporaryFileWheneverItComes)
{
    // Files 1 and 2 test that outputs are writable; 3 is the AOV, which is written slowly.
    for (const int n : {1, 2, 3}) {
        const TemporaryFolder folder;
        const Interrupter interrupter{folder.path(), n};
        Start start;
        start.while_running = [&](pid_t child) { interrupter(child); };
        const Ending ending =
            gnomon({"compare", "--builtin", "wall", "--aov", folder.path() / "a.exr", "--picture",
                    folder.path() / "p.png"},
                   start);
        expect_refused(ending, 130, "interrupted");
        for (const auto& entry : std::filesystem::directory_iterator{folder.path()}) {
            EXPECT_NE(entry.path().extension(), ".tmp") << entry.path() << ", " << n;
        }
    }
}

/// Waits for the condition: programs load slowly on a busy machine.
void wait_until(const std::function<bool()>& holds)
{
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds{30};
    while (!holds()) {
        if (std::chrono::steady_clock::now() > latest) {
            ADD_FAILURE() << "waited in vain";
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
}

/// Whether the process has a child, which is the importer.
bool is_importing(pid_t process)
{
    std::ifstream file{fmt::format("/proc/{0}/task/{0}/children", process)};
    pid_t child = 0;
    return static_cast<bool>(file >> child);
}

/// Whether the process catches SIGINT, by /proc.
bool catches_interrupts(pid_t process)
{
    std::ifstream file{fmt::format("/proc/{}/status", process)};
    std::string word;
    while (file >> word && word != "SigCgt:") {
    }
    std::uint64_t caught = 0;
    file >> std::hex >> caught;
    return (caught >> (SIGINT - 1) & 1U) != 0;
}

TEST(Interruption, EndsTheWorkAtOnce)
{
    Start start;
    start.while_running = [](pid_t child) {
        wait_until([child] { return catches_interrupts(child); });
        std::this_thread::sleep_for(std::chrono::milliseconds{300});
        ::kill(child, SIGINT);
    };
    // Many seconds of work.
    const Ending ending = gnomon({"compare", "--builtin", "sphere-field", "--set",
                                  "image.width=6000", "--set", "image.height=6000"},
                                 start);
    expect_refused(ending, 130, "interrupted");
}

/// A tessellated square that takes a while to import.
std::string large_obj()
{
    constexpr int side = 500;
    std::string text;
    for (int row = 0; row <= side; ++row) {
        for (int column = 0; column <= side; ++column) {
            text += fmt::format("v {} 0 {}\n", column, row);
        }
    }
    for (int row = 0; row < side; ++row) {
        for (int column = 1; column <= side; ++column) {
            const int corner = row * (side + 1) + column;
            text += fmt::format("f {} {} {} {}\n", corner, corner + 1, corner + side + 2,
                                corner + side + 1);
        }
    }
    return text;
}

TEST(Interruption, EndsTheImportOfASceneFile)
{
    const TemporaryFolder folder;
    const path model = folder.write("large.obj", large_obj());
    Start start;
    start.while_running = [](pid_t child) {
        wait_until([child] { return is_importing(child); });
        ::kill(-child, SIGINT); // to the importer's process too, as a terminal does
    };
    expect_refused(gnomon({"compare", model}, start), 130, "interrupted");
}

} // namespace
} // namespace gnomon::testing
