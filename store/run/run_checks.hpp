#pragma once

#include "store/sqlite.hpp"

#include <cstdint>
#include <string>

namespace gnomon::store {

/// What the checks of a run's results found.
struct RunChecks {
    std::uint64_t mismatched = 0;  ///< configurations with pixels of the kind `mismatch`
    std::uint64_t curves = 0;      ///< bias curves with results; `hardware` has none
    std::uint64_t verified = 0;    ///< of them, those held to GL's reruns
    std::uint64_t verdicts = 0;    ///< of those reruns
    std::uint64_t differences = 0; ///< verdicts that are not those of the curve

    [[nodiscard]] bool are_passed() const { return mismatched == 0 && differences == 0; }
};

/// Of the results of this part of a sweep.
[[nodiscard]] RunChecks read_run_checks(const sqlite::Database& database);

/// "12 of 12 bias curves, 0 of 525,312 verdicts differ".
[[nodiscard]] std::string verification_text(const RunChecks& checks);

/// What did not pass, and what to do; empty if everything did.
[[nodiscard]] std::string failed_checks_text(const RunChecks& checks);

} // namespace gnomon::store
