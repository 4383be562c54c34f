#pragma once

/// The program's exit status (docs/commands.md).
namespace gnomon::cli::exit_codes {

inline constexpr int done = 0;
inline constexpr int negative = 1;          ///< a regression, or `certify`, `tune` or --check fails
inline constexpr int bad_input = 2;         ///< usage, or a bad job, scene or case
inline constexpr int other_environment = 3; ///< a baseline is missing, or of another renderer
inline constexpr int environment_failed = 4; ///< GL, Embree or output failed, or mismatches
inline constexpr int incomplete = 5;         ///< failed or missing configurations
inline constexpr int interrupted = 130;

} // namespace gnomon::cli::exit_codes
