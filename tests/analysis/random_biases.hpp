#pragma once

#include "analysis/lookup/bias_order.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gnomon::analysis::test {

/// A depth of few digits, so that many pixels share a critical bias, some of them 0.
inline float random_depth(std::mt19937& random)
{
    return static_cast<float>(random() % 9) / 8.0F;
}

/// Biases at which counts change, their neighbours and a few others, ascending.
inline std::vector<float> random_biases(std::mt19937& random, const std::vector<float>& criticals)
{
    std::vector<float> biases;
    const auto add = [&](float bias) {
        if (std::isfinite(bias) && random() % 3 != 0) {
            biases.push_back(bias);
        }
    };
    for (const float critical : criticals) {
        add(previous_bias(critical));
        add(critical);
        add(next_bias(critical));
    }
    for (const float bias : {0.0F, -0.5F, 0.125F, 0.25F, bias_of_rank(1), bias_of_rank(-1),
                             bias_of_rank(largest_bias_rank), bias_of_rank(-largest_bias_rank)}) {
        add(bias);
    }
    std::sort(biases.begin(), biases.end());
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    return biases;
}

} // namespace gnomon::analysis::test
