#pragma once

#include "api/sweep/sweep.hpp"

namespace gnomon::cli {

/// `api::sweep` that tells on stderr how far it is, and that a signal ends at a good place.
[[nodiscard]] api::SweepOutcome watched_sweep(const scene::SweepSpace& space,
                                              const api::SweepRunOptions& options, bool is_quiet);

} // namespace gnomon::cli
