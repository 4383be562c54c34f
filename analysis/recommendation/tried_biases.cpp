#include "analysis/recommendation/tried_biases.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

std::vector<float> coarse_biases()
{
    std::vector<float> biases{0.0F};
    for (int i = 0; i <= 24; ++i) {
        biases.push_back(static_cast<float>(1e-6 * std::pow(10.0, i / 4.0)));
    }
    return biases;
}

std::vector<float> fine_biases()
{
    constexpr int count = 256;
    std::vector<float> biases = coarse_biases();
    for (int i = 0; i < count; ++i) {
        biases.push_back(static_cast<float>(std::pow(10.0, -7.0 + 7.0 * i / (count - 1))));
    }
    std::ranges::sort(biases);
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    return biases;
}

} // namespace gnomon::analysis
