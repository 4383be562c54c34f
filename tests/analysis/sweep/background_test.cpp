#include "analysis/sweep/background.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace gnomon::analysis {
namespace {

TEST(Background, WorksInOrder)
{
    std::vector<int> done;
    {
        Background background{1};
        for (int i = 0; i < 100; ++i) {
            background.add([&done, i] { done.push_back(i); });
        }
        background.finish();
        ASSERT_EQ(done.size(), 100U);
        background.add([&done] { done.push_back(100); });
    }
    // Its end waits for what it took on.
    ASSERT_EQ(done.size(), 101U);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

TEST(Background, TakesOnlySoManyPiecesOn)
{
    constexpr std::size_t most_pieces = 3;
    std::atomic<int> added{0};
    std::atomic<int> begun{0};
    std::atomic<bool> may_go{false};
    Background background{most_pieces};
    std::thread giver{[&] {
        for (int i = 0; i < 10; ++i) {
            background.add([&] {
                ++begun;
                while (!may_go) {
                    std::this_thread::sleep_for(std::chrono::milliseconds{1});
                }
            });
            ++added;
        }
    }};
    while (begun == 0 || added < 3) {
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    // One is worked on and two wait; a fourth would have come in by now.
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
    EXPECT_EQ(added, 3);
    EXPECT_EQ(begun, 1);
    may_go = true;
    giver.join();
    background.finish();
    EXPECT_EQ(begun, 10);
}

TEST(Background, EndsWithWhatAPieceThrewAndDropsThoseAfterIt)
{
    std::atomic<int> done{0};
    Background background{8};
    background.add([&] {
        while (done == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        throw std::runtime_error{"broken"};
    });
    background.add([&] { ADD_FAILURE() << "it was done"; });
    done = 1;
    const auto expect_broken = [](const auto& call) {
        try {
            call();
            ADD_FAILURE() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "broken");
        }
    };
    expect_broken([&] { background.finish(); });
    expect_broken([&] { background.add([] { ADD_FAILURE() << "it was done"; }); });
    expect_broken([&] { background.finish(); });
}

TEST(Background, ForgetsAnErrorThatNobodyAsksFor)
{
    Background background{1};
    background.add([] { throw std::runtime_error{"broken"}; });
    // Its end neither throws nor hangs.
}

} // namespace
} // namespace gnomon::analysis
