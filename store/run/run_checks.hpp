#pragma once

#include "store/sqlite.hpp"

#include <cstdint>
#include <string>

namespace gnomon::store {

/// Findings of the checks of a run's results.
struct RunChecks {
    std::uint64_t mismatched = 0;  ///< configurations with pixels of the kind `mismatch`
    std::uint64_t curves = 0;      ///< bias curves with results; 0 for `hardware`
    std::uint64_t verified = 0;    ///< curves that were checked against reruns by GL
    std::uint64_t verdicts = 0;    ///< pixels' verdicts in those reruns
    std::uint64_t differences = 0; ///< verdicts that differ from the curve's

    [[nodiscard]] bool are_passed() const { return mismatched == 0 && differences == 0; }
};

/// Reads the checks of this part of a sweep.
[[nodiscard]] RunChecks read_run_checks(const sqlite::Database& database);

/// "12 of 12 bias curves, 0 of 525,312 verdicts differ".
[[nodiscard]] std::string verification_text(const RunChecks& checks);

/// Which checks failed, and what to do; empty if all passed.
[[nodiscard]] std::string failed_checks_text(const RunChecks& checks);

} // namespace gnomon::store
