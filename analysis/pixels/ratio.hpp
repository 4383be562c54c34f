#pragma once

#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// part / whole; empty if the whole is 0, for then there is no share to speak of.
[[nodiscard]] inline std::optional<double> ratio(double part, std::uint64_t whole)
{
    if (whole == 0) {
        return std::nullopt;
    }
    return part / static_cast<double>(whole);
}

[[nodiscard]] inline std::optional<double> ratio(std::uint64_t part, std::uint64_t whole)
{
    return ratio(static_cast<double>(part), whole);
}

} // namespace gnomon::analysis
