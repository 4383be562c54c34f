#pragma once

#include "scene/text.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::reports {

using scene::counted;
using scene::grouped;

/// An amount of pixels: whole and grouped from 100 on, below with three digits and at most three
/// decimals: "367,864", "12.4", "0.003", "<0.001".
[[nodiscard]] std::string grouped_amount(double pixels);

/// A fraction in percent with three significant digits, at most four decimals: "1.23 %". Values
/// that would round to zero are "<0.0001 %"; an empty one is "-".
[[nodiscard]] std::string percent(std::optional<double> fraction);

/// The value, but 0 for -0, so that no minus sign is printed.
[[nodiscard]] constexpr double plain_zero(double value)
{
    return value == 0 ? 0 : value;
}

/// The text with an upper-case first letter (ASCII only).
[[nodiscard]] std::string capitalised(std::string text);

/// Width of a UTF-8 text in code points.
[[nodiscard]] std::size_t text_columns(std::string_view text);

/// The first `columns` code points of a UTF-8 text.
[[nodiscard]] std::string_view first_columns(std::string_view text, std::size_t columns);

/// Appends, or prepends, blanks up to `columns`.
[[nodiscard]] std::string pad_right(std::string_view text, std::size_t columns);
[[nodiscard]] std::string pad_left(std::string_view text, std::size_t columns);

} // namespace gnomon::reports
