#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/comparison_session.hpp"

namespace gnomon::cli {

/// Where float32 matrices and positions cost more than the depth format, compares the same scene
/// with its origin moved near, and adds what that leaves to the comparison's advice.
void advise_origin(analysis::Comparison& comparison, const api::ComparisonSession& session,
                   const api::SessionOptions& options);

} // namespace gnomon::cli
