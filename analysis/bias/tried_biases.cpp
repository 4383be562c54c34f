#include "analysis/bias/tried_biases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace gnomon::analysis {

std::vector<float> tried_biases()
{
    constexpr int count = 256;
    std::vector<float> biases{0.0F};
    for (int i = 0; i < count; ++i) {
        biases.push_back(static_cast<float>(std::pow(10.0, -7.0 + 7.0 * i / (count - 1))));
    }
    return biases;
}

std::span<const float> around_least(std::span<const float> biases,
                                    std::span<const ErrorAmounts> amounts)
{
    constexpr std::ptrdiff_t most = 64;
    const auto least = std::ranges::min_element(amounts, {}, &ErrorAmounts::total);
    const std::ptrdiff_t last = std::ssize(biases) - most;
    const std::ptrdiff_t first = std::clamp(least - amounts.begin() - most / 2, std::ptrdiff_t{0},
                                            std::max(last, std::ptrdiff_t{0}));
    return biases.subspan(static_cast<std::size_t>(first),
                          static_cast<std::size_t>(std::min(most, std::ssize(biases))));
}

} // namespace gnomon::analysis
