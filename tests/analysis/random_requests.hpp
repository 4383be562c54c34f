#pragma once

#include "analysis/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Keys of random jobs, built like `stage_keys` from a few values of each part.
inline std::vector<CurveRequest> random_requests(std::mt19937& random)
{
    const auto pick = [&](std::uint64_t most, const char* name) {
        return fmt::format("{}{} ", name, random() % most);
    };
    const std::uint64_t scenes = 1 + random() % 3;
    const std::uint64_t lights = 1 + random() % 3;
    const std::uint64_t cameras = 1 + random() % 5;
    const std::uint64_t frusta = 1 + random() % 3;
    const std::uint64_t maps = 1 + random() % 3;
    const bool looks_up_at_pixels = random() % 2 == 0;
    std::map<std::string, CurveRequest> by_curve;
    const std::size_t count = 1 + random() % 40;
    for (std::size_t i = 0; i < count; ++i) {
        CurveRequest request;
        StageKeys& keys = request.keys;
        keys.scene = pick(scenes, "s");
        keys.light = keys.scene + pick(lights, "l");
        const std::string camera = pick(cameras, "c");
        keys.camera = keys.scene + camera;
        keys.truth = keys.light + camera;
        const std::string frustum = pick(frusta, "f");
        const bool follows_camera = frustum.starts_with("f0");
        keys.frustum = (follows_camera ? keys.truth : keys.light) + frustum;
        keys.receivers = looks_up_at_pixels ? keys.camera : keys.truth + frustum;
        const std::string map = pick(maps, "m");
        keys.map = keys.frustum + map;
        // One method in three has no prefilter.
        const std::string made = pick(3, "p");
        const bool is_filtered = !made.starts_with("p0");
        keys.filtered = is_filtered ? keys.map + made : std::string{};
        keys.lookup = keys.truth + frustum + map + made + pick(2, "k");
        keys.curve = keys.lookup + pick(2, "b");
        request.pixels = 1 + random() % 1'000'000;
        request.texels = 1 + random() % 1'000'000;
        by_curve.try_emplace(keys.curve, request);
    }
    std::vector<CurveRequest> requests;
    std::uint64_t ordinal = 0;
    for (auto& [curve, request] : by_curve) {
        for (std::size_t i = 1 + random() % 4; i-- > 0;) {
            request.ordinals.push_back(ordinal++);
        }
        requests.push_back(request);
    }
    std::shuffle(requests.begin(), requests.end(), random);
    return requests;
}

inline std::string text_of(const std::vector<CurveRequest>& requests, std::size_t slots)
{
    std::string text = fmt::format("{} slots:", slots);
    for (const CurveRequest& request : requests) {
        text += "\n  " + request.keys.curve;
    }
    return text;
}

} // namespace gnomon::analysis
