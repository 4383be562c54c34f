#pragma once

#include "analysis/depth/depth_plan.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// Which near plane and format meet the target, a line a format.
[[nodiscard]] std::string depth_plan_text(const analysis::PlanTarget& target,
                                          std::span<const analysis::PlanAnswer> answers);

/// The same as one JSON object; docs/depth_precision.md names its members.
[[nodiscard]] std::string depth_plan_json(const analysis::PlanTarget& target,
                                          std::span<const analysis::PlanAnswer> answers);

} // namespace gnomon::reports
