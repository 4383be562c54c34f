#include "reports/text/shares.hpp"

#include <fmt/format.h>

namespace gnomon::reports {

std::string share_of(double part, double whole)
{
    const double percent = 100.0 * part / whole;
    if (part != whole && percent > 99) {
        return "over 99 %";
    }
    return percent < 1 ? "under 1 %" : fmt::format("{:.0f} %", percent);
}

} // namespace gnomon::reports
