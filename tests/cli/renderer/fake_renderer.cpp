#include "renderer/fake_renderer.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

namespace gnomon::testing {
namespace {

namespace fs = std::filesystem;

/// Processes whose command line has the mark.
std::vector<std::string> processes_with(const std::string& mark)
{
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator entry{"/proc", error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        std::ifstream file{entry->path() / "cmdline"};
        std::string command;
        std::getline(file, command); // reads nothing if the process has just ended
        if (command.find(mark) != std::string::npos) {
            found.push_back(entry->path().filename().string());
        }
    }
    return found;
}

/// `processes`, after those that are being killed had time to end.
std::vector<std::string> processes_left(const std::string& mark)
{
    for (int i = 0; i < 200 && !processes_with(mark).empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
    }
    return processes_with(mark);
}

} // namespace

FakeRenderer::FakeRenderer(const std::string& way)
    : mark_{fmt::format("fake-{}-{}", ::getpid(), way)},
      command_{fmt::format("/usr/bin/python3 '{}/tests/cli/renderer/fake_renderer.py' {} {}",
                           GNOMON_ROOT, way, mark_)}
{
}

Start FakeRenderer::start() const
{
    Start start;
    start.environment = {fmt::format("TMPDIR={}", temporary_.path().string()),
                         fmt::format("FAKE_LOG={}", (own_.path() / "starts").string())};
    return start;
}

int FakeRenderer::starts() const
{
    const std::string log = text_of(own_.path() / "starts");
    return static_cast<int>(std::ranges::count(log, '\n'));
}

void FakeRenderer::expect_nothing_left() const
{
    EXPECT_THAT(processes_left(mark_), ::testing::IsEmpty());
    // The folder is removed after the last process has ended.
    for (int i = 0; i < 100 && !fs::is_empty(temporary_.path()); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
    }
    EXPECT_TRUE(fs::is_empty(temporary_.path()));
}

} // namespace gnomon::testing
