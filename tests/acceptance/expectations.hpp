#pragma once

#include "analysis/comparison/comparison.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::tests {

/// Expects an independent checker to certify the truth, including every indeterminate pixel.
/// @param sample  The number of surface pixels to derive. Empty: the checker's default.
void expect_certified(const analysis::Comparison& result,
                      const std::optional<std::uint64_t>& sample);

/// Expects exactly one cause and one label for every wrong pixel and for its amount.
void expect_all_explained(const analysis::Comparison& result, const std::string& label);

} // namespace gnomon::tests
