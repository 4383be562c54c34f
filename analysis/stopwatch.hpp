#pragma once

#include <chrono>
#include <functional>

namespace gnomon::analysis {

/// Adds the wall time since it was made to `seconds` when it goes out of scope.
class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_{seconds} {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

/// Runs `work` and adds its wall time to `seconds`.
template <typename Work>
auto timed(double& seconds, const Work& work)
{
    const Stopwatch stopwatch{seconds};
    return work();
}

/// Seconds since it was made.
[[nodiscard]] inline std::function<double()> started_clock()
{
    const auto start = std::chrono::steady_clock::now();
    return [start] {
        return std::chrono::duration<double>{std::chrono::steady_clock::now() - start}.count();
    };
}

} // namespace gnomon::analysis
