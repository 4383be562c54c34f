#pragma once

#include "scene/counted.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::reports {

using scene::counted;
using scene::grouped;

/// An amount of pixels: whole and grouped from 100 on, else with as many decimals as make three
/// digits, at most three: "367,864", "12.4", "0.003"; what is smaller "<0.001".
[[nodiscard]] std::string grouped_amount(double pixels);

/// A fraction in percent with three significant digits, at most four decimals: "1.23 %"; what is
/// not zero never prints as zero ("<0.0001 %"); "-" if there is none.
[[nodiscard]] std::string percent(std::optional<double> fraction);

/// The number itself, but 0 for -0, whose sign says nothing to people.
[[nodiscard]] constexpr double plain_zero(double value)
{
    return value == 0 ? 0 : value;
}

/// The text with an upper-case first letter, of ASCII.
[[nodiscard]] std::string capitalised(std::string text);

/// Width of a UTF-8 text in code points.
[[nodiscard]] std::size_t text_columns(std::string_view text);

/// The first code points of a UTF-8 text, whole ones, at most so many.
[[nodiscard]] std::string_view first_columns(std::string_view text, std::size_t columns);

/// The text followed, or preceded, by blanks up to `columns`.
[[nodiscard]] std::string pad_right(std::string_view text, std::size_t columns);
[[nodiscard]] std::string pad_left(std::string_view text, std::size_t columns);

} // namespace gnomon::reports
