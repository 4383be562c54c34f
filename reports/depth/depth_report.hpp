#pragma once

#include "analysis/depth/depth_plan.hpp"
#include "analysis/depth/depth_study.hpp"
#include "reports/depth/drawing.hpp"

#include <span>
#include <string>

/// The outputs of `gnomon depth`. JSON members and CSV columns: docs/depth_precision.md.
/// `rows` are the samples to show: measured ones, or the formula's. `gl_renderer` and `gl_version`
/// are empty if nothing was measured.
namespace gnomon::reports {

/// A study as text: the request, the formulas, GL's stored depths, and a few sample distances.
[[nodiscard]] std::string depth_table(const analysis::DepthStudy& study,
                                      std::span<const analysis::DepthErrorRow> rows,
                                      const std::string& gl_renderer);

/// A study as one JSON object.
[[nodiscard]] std::string depth_json(const analysis::DepthStudy& study,
                                     std::span<const analysis::DepthErrorRow> rows,
                                     const std::string& gl_renderer, const std::string& gl_version);

/// One line per sample under a header. Unmeasured values are empty cells; `tolerance_m` is a column
/// only if the study has a tolerance.
[[nodiscard]] std::string depth_csv(const analysis::DepthStudy& study,
                                    std::span<const analysis::DepthErrorRow> rows);

/// Plots error against distance: the formula's sawtooth and envelope, and GL's measured errors.
/// The error axis is logarithmic; so is the distance axis if far is more than 100 times near. A
/// tolerance is a horizontal line, and a vertical one where the envelope first exceeds it.
/// @param rows  Measured, by growing distance; ignored if the study has no measurement.
[[nodiscard]] Drawing depth_plot(const analysis::DepthStudy& study,
                                 std::span<const analysis::DepthErrorRow> rows,
                                 const std::string& gl_renderer);

/// Compares formats for one frustum, one line each.
/// @param studies  at least one.
[[nodiscard]] std::string depth_comparison_table(std::span<const analysis::DepthStudy> studies,
                                                 const std::string& gl_renderer);

/// The comparison as one JSON object: "formats", each theory and measurement without samples.
[[nodiscard]] std::string depth_comparison_json(std::span<const analysis::DepthStudy> studies,
                                                const std::string& gl_renderer,
                                                const std::string& gl_version);

/// Which near plane and format meet the target, one line per format.
[[nodiscard]] std::string depth_plan_text(const analysis::PlanTarget& target,
                                          std::span<const analysis::PlanAnswer> answers);

/// The plan as one JSON object.
[[nodiscard]] std::string depth_plan_json(const analysis::PlanTarget& target,
                                          std::span<const analysis::PlanAnswer> answers);

} // namespace gnomon::reports
