#include "analysis/sweep/background_worker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace gnomon::analysis {
namespace {

TEST(BackgroundWorker, WorksInOrder)
{
    std::vector<int> done;
    {
        BackgroundWorker worker{1};
        for (int i = 0; i < 100; ++i) {
            worker.add([&done, i] { done.push_back(i); });
        }
        worker.finish();
        ASSERT_EQ(done.size(), 100U);
        worker.add([&done] { done.push_back(100); });
    }
    // Its destructor waits for its pieces.
    ASSERT_EQ(done.size(), 101U);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

TEST(BackgroundWorker, TakesOnlySoManyPiecesOn)
{
    constexpr std::size_t most_pieces = 3;
    std::atomic<int> added{0};
    std::atomic<int> begun{0};
    std::atomic<bool> may_go{false};
    BackgroundWorker worker{most_pieces};
    std::thread giver{[&] {
        for (int i = 0; i < 10; ++i) {
            worker.add([&] {
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
    // One is in progress and two wait; a fourth would have entered by now.
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
    EXPECT_EQ(added, 3);
    EXPECT_EQ(begun, 1);
    may_go = true;
    giver.join();
    worker.finish();
    EXPECT_EQ(begun, 10);
}

TEST(BackgroundWorker, EndsWithWhatAPieceThrewAndDropsThoseAfterIt)
{
    std::atomic<int> done{0};
    BackgroundWorker worker{8};
    worker.add([&] {
        while (done == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        throw std::runtime_error{"broken"};
    });
    worker.add([&] { ADD_FAILURE() << "it was done"; });
    done = 1;
    const auto expect_broken = [](const auto& call) {
        try {
            call();
            ADD_FAILURE() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "broken");
        }
    };
    expect_broken([&] { worker.finish(); });
    expect_broken([&] { worker.add([] { ADD_FAILURE() << "it was done"; }); });
    expect_broken([&] { worker.finish(); });
}

TEST(BackgroundWorker, ForgetsAnErrorThatNobodyAsksFor)
{
    BackgroundWorker worker{1};
    worker.add([] { throw std::runtime_error{"broken"}; });
    // Its destructor neither throws nor hangs.
}

} // namespace
} // namespace gnomon::analysis
