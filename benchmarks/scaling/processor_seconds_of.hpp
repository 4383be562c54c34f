#pragma once

#include <ctime>

namespace gnomon::benchmarks {

/// Processor time of this process, all its threads together [s].
[[nodiscard]] inline double processor_seconds()
{
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs `work` and adds what processors spent on it to `seconds`: unlike wall time, it depends
/// little on what else the machine does.
template <typename Work>
auto processor_timed(double& seconds, const Work& work)
{
    const double begin_s = processor_seconds();
    auto result = work();
    seconds += processor_seconds() - begin_s;
    return result;
}

} // namespace gnomon::benchmarks
