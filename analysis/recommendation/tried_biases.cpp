#include "analysis/recommendation/tried_biases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace gnomon::analysis {

namespace {

/// Biases around the least amount of error of which causes are found.
constexpr std::ptrdiff_t most_around = 64;

} // namespace

std::vector<float> tried_biases()
{
    constexpr int count = 256;
    std::vector<float> biases{0.0F};
    for (int i = 0; i < count; ++i) {
        biases.push_back(static_cast<float>(std::pow(10.0, -7.0 + 7.0 * i / (count - 1))));
    }
    return biases;
}

std::vector<float> coarse_biases()
{
    std::vector<float> biases{0.0F};
    for (int i = 0; i <= 24; ++i) {
        biases.push_back(static_cast<float>(1e-6 * std::pow(10.0, i / 4.0)));
    }
    return biases;
}

std::vector<float> coarse_biases_around_least(std::span<const float> coarse,
                                              std::span<const ErrorAmounts> amounts)
{
    constexpr std::ptrdiff_t steps = 3;
    const std::ptrdiff_t least =
        std::ranges::min_element(amounts, {}, &ErrorAmounts::total) - amounts.begin();
    const std::ptrdiff_t first = std::max(least - steps, std::ptrdiff_t{0});
    const std::ptrdiff_t last = std::min(least + steps, std::ssize(coarse) - 1);
    return {coarse.begin() + first, coarse.begin() + last + 1};
}

std::vector<float> fine_biases_around_least(std::span<const float> coarse,
                                            std::span<const ErrorAmounts> amounts)
{
    std::vector<float> biases = coarse_biases_around_least(coarse, amounts);
    std::ranges::copy_if(
        tried_biases(), std::back_inserter(biases),
        [lo = biases.front(), hi = biases.back()](float bias) { return lo < bias && bias < hi; });
    std::ranges::sort(biases);
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    const std::ptrdiff_t too_many = std::ssize(biases) - most_around;
    if (too_many > 0) { // next to 0: the smallest differ least from it
        biases.erase(biases.begin() + 1, biases.begin() + 1 + too_many);
    }
    return biases;
}

std::span<const float> around_least(std::span<const float> biases,
                                    std::span<const ErrorAmounts> amounts)
{
    const auto least = std::ranges::min_element(amounts, {}, &ErrorAmounts::total);
    const std::ptrdiff_t last = std::ssize(biases) - most_around;
    const std::ptrdiff_t first = std::clamp(least - amounts.begin() - most_around / 2,
                                            std::ptrdiff_t{0}, std::max(last, std::ptrdiff_t{0}));
    return biases.subspan(static_cast<std::size_t>(first),
                          static_cast<std::size_t>(std::min(most_around, std::ssize(biases))));
}

} // namespace gnomon::analysis
