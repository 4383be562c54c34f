// Progress lines of commands.

#include "cli/system/announced_renderers.hpp"
#include "cli/system/progress.hpp"
#include "fake_renderers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

namespace gnomon::cli {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;

constexpr const char* cleared = "\r\x1b[K";

/// While it lives, stderr is a terminal.
class Terminal {
public:
    Terminal() : saved_{::dup(STDERR_FILENO)}
    {
        int slave = -1;
        EXPECT_EQ(::openpty(&master_, &slave, nullptr, nullptr, nullptr), 0);
        ::dup2(slave, STDERR_FILENO);
        ::close(slave);
        ::fcntl(master_, F_SETFL, O_NONBLOCK);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal()
    {
        ::dup2(saved_, STDERR_FILENO);
        ::close(saved_);
        ::close(master_);
    }

    /// The output since the last call.
    [[nodiscard]] std::string text() const
    {
        std::fflush(stderr);
        std::string all;
        std::array<char, 4096> part{};
        while (true) {
            const ssize_t count = ::read(master_, part.data(), part.size());
            if (count <= 0) {
                return all;
            }
            all.append(part.data(), static_cast<std::size_t>(count));
        }
    }

    /// The output up to the text; fails if it never comes.
    [[nodiscard]] std::string text_until(const std::string& wanted) const
    {
        std::string all;
        for (int tries = 0; tries < 600 && all.find(wanted) == std::string::npos; ++tries) {
            std::this_thread::sleep_for(100ms);
            all += text();
        }
        EXPECT_THAT(all, HasSubstr(wanted));
        return all;
    }

private:
    int saved_;
    int master_ = -1;
};

TEST(SlowWork, IsNotSpokenOfWhileItIsQuick)
{
    const Terminal terminal;
    {
        SlowWork work{"reading the scene"};
        work.now("drawing the shadow map");
    }
    EXPECT_EQ(terminal.text(), "");
}

TEST(SlowWork, SaysOnATerminalWhatItIsAtAndClearsTheLine)
{
    const Terminal terminal;
    {
        SlowWork work{"reading the scene"};
        int drawn = 0;
        tests::FakeRenderers fake;
        fake.rasterizer.on_map = [&] { ++drawn; };
        const AnnouncedRenderers told{fake.renderers(), work};
        EXPECT_FALSE(told.renderers().reference.has_light_queries()) << "as its own";
        (void)told.renderers().rasterizer.draw_map({}, {}, {});
        EXPECT_EQ(drawn, 1);
        EXPECT_THAT(terminal.text_until("s: drawing the shadow map"), Not(HasSubstr("\n")));
        work.now("writing");
        EXPECT_THAT(terminal.text_until("s: writing"), Not(HasSubstr("\n")));
    }
    EXPECT_THAT(terminal.text(), EndsWith(cleared));
}

} // namespace
} // namespace gnomon::cli
