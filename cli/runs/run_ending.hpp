#pragma once

#include "store/run/run_status.hpp"

namespace gnomon::cli {

/// Ends the program with the exit status that a run's status calls for, as the sweep did: 5 if it
/// is incomplete, 4 if a check of its results did not pass; returns otherwise.
void end_as(const store::RunStatus& status);

} // namespace gnomon::cli
