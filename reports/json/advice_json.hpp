#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "store/json.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// Adds `remedies`, `advice`, `views` and `views_passed_over` (docs/json_schema.md).
/// @param comparison  with a diagnosis.
void add_advice(store::Json& json, const analysis::Comparison& comparison);

/// Which methods a search passed over, and why.
[[nodiscard]] store::Json
methods_passed_over_json(const std::vector<analysis::PassedOverMethod>& passed_over);

/// What a setting gives in a view: counts and their rates, amounts, softening, and the rate of the
/// amounts without softening. Rates without a denominator are null.
[[nodiscard]] store::Json outcome_json(const analysis::ViewOutcome& outcome);

/// A view's name, eye, target, up and light.
[[nodiscard]] store::Json view_json(const std::string& name, const scene::CameraSettings& camera,
                                    const scene::LightSettings& light);

} // namespace gnomon::reports
