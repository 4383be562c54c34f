#include "reference_rt/traversal/embree_scene.hpp"
#include "scene/geometry/triangles.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

namespace gnomon::reference_rt {
namespace {

/// So many vertices that sorting dominates.
scene::TriangleScene many_vertices()
{
    scene::TriangleScene scene;
    std::minstd_rand random{7};
    std::uniform_real_distribution<float> place{-1, 1};
    for (int i = 0; i < 3'000'000; ++i) {
        scene.vertices.emplace_back(place(random), place(random), place(random));
    }
    scene.triangles.push_back({0, 1, 2});
    scene.objects.push_back({"triangle", 0, 1});
    return scene;
}

/// A thread that builds the fans sorts in parallel. While it waits for other threads, it must not
/// start a task that needs the fans, or this test would never end. One thread offers such tasks and
/// runs none; enough threads help to sort that some are still busy when the first has finished its
/// part.
TEST(CornerFans, AreMadeWhileTasksThatAskForThemWait)
{
    constexpr int threads = 32;
    const tbb::global_control at_most{tbb::global_control::max_allowed_parallelism, threads};
    const scene::TriangleScene vertices = many_vertices();
    const ReferenceScene reference{vertices};
    std::atomic<bool> are_made = false;
    std::atomic<int> asked = 0;
    const auto ask = [&] {
        (void)reference.implementation().corner_fans();
        ++asked;
    };
    const auto offer = [&] {
        tbb::task_group offered;
        for (int i = 0; i < 64; ++i) {
            offered.run(ask);
        }
        while (!are_made) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        offered.wait();
    };
    tbb::task_arena arena{threads};
    arena.execute([&] {
        tbb::task_group group;
        group.run([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds{60});
            offer();
        });
        std::this_thread::sleep_for(std::chrono::milliseconds{10}); // another thread takes that up
        ask();
        are_made = true;
        group.wait();
    });
    EXPECT_EQ(asked, 65);
}

} // namespace
} // namespace gnomon::reference_rt
