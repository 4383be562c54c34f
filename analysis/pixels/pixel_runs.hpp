#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace gnomon::analysis {

/// Calls `run(first, last)` in parallel for ranges of pixels that together cover [0, pixel_count).
template <typename Run>
void for_each_run(std::size_t pixel_count, const Run& run)
{
    constexpr std::size_t pixels_per_run = 16384; // makes the cost of starting a task negligible
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>{0, pixel_count, pixels_per_run},
        [&](const tbb::blocked_range<std::size_t>& pixels) { run(pixels.begin(), pixels.end()); });
}

/// Adds up `count(first, last, sum)` over ranges of pixels, in any order.
/// @param zero  The initial sum; has `add(const Sum&)`.
template <typename Sum, typename Count>
Sum sum_over_runs(std::size_t pixels, const Sum& zero, const Count& count)
{
    tbb::enumerable_thread_specific<Sum> parts{zero};
    for_each_run(pixels,
                 [&](std::size_t first, std::size_t last) { count(first, last, parts.local()); });
    Sum sum = zero;
    for (const Sum& part : parts) {
        sum.add(part);
    }
    return sum;
}

} // namespace gnomon::analysis
