#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace gnomon::analysis {

/// Calls `run(first, last)` for runs of pixels that together cover [0, pixel_count), several at the
/// same time.
template <typename Run>
void for_each_run(std::size_t pixel_count, const Run& run)
{
    constexpr std::size_t pixels_per_run = 16384; // little beside what starting a task costs
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>{0, pixel_count, pixels_per_run},
        [&](const tbb::blocked_range<std::size_t>& pixels) { run(pixels.begin(), pixels.end()); });
}

} // namespace gnomon::analysis
