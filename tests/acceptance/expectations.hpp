#pragma once

#include "analysis/comparison/comparison.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::tests {

/// Fails unless an independent checker certifies the truth, all that is indeterminate with it.
/// @param sample  Surface pixels to derive anew; empty: the checker's own number.
void expect_certified(const analysis::Comparison& result,
                      const std::optional<std::uint64_t>& sample);

/// Fails unless every wrong pixel has exactly one cause and one label, and so have the amounts.
void expect_all_explained(const analysis::Comparison& result, const std::string& label);

} // namespace gnomon::tests
