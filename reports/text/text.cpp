#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gnomon::reports {

namespace {

bool starts_code_point(char c)
{
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

} // namespace

std::string capitalised(std::string text)
{
    if (!text.empty()) {
        text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    }
    return text;
}

std::string grouped_amount(double pixels)
{
    if (pixels >= 99.95) {
        return grouped(static_cast<std::uint64_t>(std::llround(pixels)));
    }
    if (pixels > 0 && pixels < 0.0005) {
        return "<0.001";
    }
    const int decimals = pixels >= 9.995 ? 1 : (pixels >= 0.9995 ? 2 : 3);
    return pixels == 0 ? "0" : fmt::format("{:.{}f}", pixels, decimals);
}

std::string percent(std::optional<double> fraction)
{
    if (!fraction) {
        return "-";
    }
    constexpr double smallest_shown = 0.0001;
    constexpr int most_decimals = 4;
    const double value = 100 * *fraction;
    if (value == 0) {
        return "0 %";
    }
    if (value < smallest_shown) {
        return "<0.0001 %";
    }
    const int decimals = 2 - static_cast<int>(std::floor(std::log10(value)));
    return fmt::format("{:.{}f} %", value, std::clamp(decimals, 0, most_decimals));
}

std::size_t text_columns(std::string_view text)
{
    return static_cast<std::size_t>(std::ranges::count_if(text, starts_code_point));
}

std::string_view first_columns(std::string_view text, std::size_t columns)
{
    std::size_t end = 0;
    for (std::size_t taken = 0; end < text.size(); ++end) {
        if (starts_code_point(text[end]) && taken++ == columns) {
            break;
        }
    }
    return text.substr(0, end);
}

std::string pad_right(std::string_view text, std::size_t columns)
{
    return std::string{text} + std::string(columns - std::min(columns, text_columns(text)), ' ');
}

std::string pad_left(std::string_view text, std::size_t columns)
{
    return std::string(columns - std::min(columns, text_columns(text)), ' ') + std::string{text};
}

} // namespace gnomon::reports
