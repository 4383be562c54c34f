#include "analysis/sweep/cost.hpp"

#include "random_requests.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace gnomon::analysis {
namespace {

using Kind = SweepStep::Kind;

TEST(SweepCost, KeepsFewerCamerasOfLargerImages)
{
    std::vector<CurveRequest> requests(1);
    requests[0].pixels = 1;
    const std::size_t most = camera_slots(requests);
    EXPECT_GE(most, 2U);
    std::size_t before = most;
    for (std::uint64_t pixels = 1; pixels <= std::uint64_t{1} << 28; pixels *= 2) {
        requests[0].pixels = pixels;
        EXPECT_LE(camera_slots(requests), before) << pixels;
        before = camera_slots(requests);
    }
    EXPECT_EQ(before, 1U);
    EXPECT_EQ(camera_slots({}), most);
}

TEST(SweepCost, KeepsFewerCamerasBesideLargerMaps)
{
    const auto slots = [](std::uint64_t pixels, std::uint64_t map_side) {
        std::vector<CurveRequest> requests(1);
        requests[0].pixels = pixels;
        requests[0].texels = map_side * map_side;
        return camera_slots(requests);
    };
    constexpr std::uint64_t hd = std::uint64_t{1280} * 720;
    constexpr std::uint64_t full_hd = std::uint64_t{1920} * 1080;
    EXPECT_EQ(slots(full_hd, 8192), 1U); // of 1.5 GiB, which a sweep stays below
    EXPECT_GE(slots(full_hd, 4096), 2U);
    EXPECT_GE(slots(hd, 8192), 2U);
    EXPECT_GT(slots(hd, 1024), slots(hd, 8192));
}

TEST(SweepCost, GrowsWithTheWork)
{
    CurveRequest small;
    small.pixels = 1000;
    small.texels = 1000;
    small.ordinals = {0};
    CurveRequest large = small;
    large.pixels = 2'000'000;
    large.texels = 4'000'000;
    large.ordinals.resize(1000);
    for (const Kind kind : {Kind::draw_receivers, Kind::find_truth, Kind::draw_shadow_map,
                            Kind::prefilter, Kind::look_up, Kind::answer}) {
        const SweepStep step{kind, 0, 0};
        EXPECT_GT(estimate_seconds(step, small), 0) << static_cast<int>(kind);
        EXPECT_GT(estimate_seconds(step, large), estimate_seconds(step, small))
            << static_cast<int>(kind);
    }
    const std::vector<CurveRequest> requests{small, large};
    const SweepPlan plan = make_plan(requests, 1);
    double sum = 0;
    for (const SweepStep& step : plan.steps) {
        sum += estimate_seconds(step, requests[step.curve]);
    }
    EXPECT_EQ(estimate_seconds(plan, requests), sum);
    EXPECT_LT(estimate_bytes(make_plan(std::span{&small, 1}, 1), std::span{&small, 1}),
              estimate_bytes(plan, requests));
}

/// The cost of each request: its answer and the steps that lead to it.
std::vector<double> costs_in_plan_order(const SweepPlan& plan,
                                        const std::vector<CurveRequest>& requests,
                                        std::vector<std::size_t>& order)
{
    std::vector<double> costs;
    double pending = 0;
    for (const SweepStep& step : plan.steps) {
        pending += estimate_seconds(step, requests[step.curve]);
        if (step.kind == Kind::answer) {
            costs.push_back(pending);
            order.push_back(step.curve);
            pending = 0;
        }
    }
    return costs;
}

TEST(SweepCost, DividesNeighboursEvenly)
{
    std::mt19937 random{26};
    for (int round = 0; round < 300; ++round) {
        const auto requests = random_requests(random);
        const auto shards = static_cast<std::uint32_t>(1 + random() % 6);
        SCOPED_TRACE(fmt::format("round {}, {} shards: {}", round, shards, text_of(requests, 2)));
        const SweepPlan plan = make_plan(requests, 2);
        std::vector<std::size_t> order;
        const auto costs = costs_in_plan_order(plan, requests, order);
        const auto shard_of = divide(plan, requests, shards);
        ASSERT_EQ(shard_of.size(), requests.size());
        std::vector<double> sums(shards);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::uint32_t shard = shard_of[order[i]];
            ASSERT_GE(shard, 1U);
            ASSERT_LE(shard, shards);
            if (i > 0) {
                EXPECT_GE(shard, shard_of[order[i - 1]]) << "not contiguous";
            }
            sums[shard - 1] += costs[i];
        }
        // A request goes where its middle lies, so that each end of a part is off by at most half
        // of a request's cost.
        const double fair = std::accumulate(costs.begin(), costs.end(), 0.0) / shards;
        const double largest = *std::max_element(costs.begin(), costs.end());
        for (const double sum : sums) {
            // 1e-9: sums of up to some hundred doubles.
            EXPECT_NEAR(sum, fair, largest * (1 + 1e-9));
        }
    }
}

TEST(SweepCost, GivesOneShardEverything)
{
    std::mt19937 random{27};
    const auto requests = random_requests(random);
    EXPECT_THAT(divide(make_plan(requests, 1), requests, 1), ::testing::Each(1U));
}

} // namespace
} // namespace gnomon::analysis
