#pragma once

#include <chrono>

namespace gnomon::api {

/// Runs `work` and adds its wall time to `seconds`.
template <typename Work>
auto timed(double& seconds, const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace gnomon::api
