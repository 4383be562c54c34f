#pragma once

#include "scene/image.hpp"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::analysis {

/// Calls `explain(pixels)` in parallel for the pixels for which `wants(pixel)`, one square of the
/// image at a time. Neighbours share texels and triangles, so squares are not too small and list
/// their pixels in blocks of 4×4.
/// @param taps_each  Taps of a pixel; bounds the memory of a square.
template <typename Wants, typename Explain>
void explain_in_squares(scene::ImageSize size, std::size_t taps_each, const Wants& wants,
                        const Explain& explain)
{
    constexpr double taps_at_once = 0x1p18;
    constexpr int largest_side_px = 128; // the data of such a square fits a core's cache
    constexpr int step_px = 4;
    const auto fitting = static_cast<int>(std::sqrt(taps_at_once / static_cast<double>(taps_each)));
    const int side = std::min(largest_side_px, fitting / step_px * step_px);
    const auto [width_px, height_px] = size;
    const auto collect = [&](int left, int top) {
        std::vector<std::size_t> pixels;
        const int right = std::min(width_px, left + side);
        const int bottom = std::min(height_px, top + side);
        for (int y0 = top; y0 < bottom; y0 += step_px) {
            for (int x0 = left; x0 < right; x0 += step_px) {
                for (int y = y0; y < std::min(y0 + step_px, bottom); ++y) {
                    for (int x = x0; x < std::min(x0 + step_px, right); ++x) {
                        const std::size_t pixel =
                            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                            static_cast<std::size_t>(x);
                        if (wants(pixel)) {
                            pixels.push_back(pixel);
                        }
                    }
                }
            }
        }
        return pixels;
    };
    const tbb::blocked_range2d<int> squares{0, (height_px + side - 1) / side, 1,
                                            0, (width_px + side - 1) / side,  1};
    tbb::parallel_for(
        squares,
        [&](const tbb::blocked_range2d<int>& range) {
            for (int row = range.rows().begin(); row != range.rows().end(); ++row) {
                for (int column = range.cols().begin(); column != range.cols().end(); ++column) {
                    if (const auto pixels = collect(column * side, row * side); !pixels.empty()) {
                        explain(pixels);
                    }
                }
            }
        },
        tbb::simple_partitioner{});
}

} // namespace gnomon::analysis
