#pragma once

#include <chrono>

namespace gnomon::benchmarks {

/// Wall time of `work()` [s].
template <typename Work>
[[nodiscard]] double seconds_of(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace gnomon::benchmarks
