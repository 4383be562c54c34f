#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// The head of a case's table: renderer, scene, light, image and how P lies to the mesh.
/// @param evaluation  of that comparison.
[[nodiscard]] std::string evaluation_settings(const analysis::Comparison& comparison,
                                              const analysis::Evaluation& evaluation);

/// What a case tells of its errors where there is no diagnosis, and what it cannot tell.
/// @param evaluation  of that comparison.
[[nodiscard]] std::string evaluation_table(const analysis::Comparison& comparison,
                                           const analysis::Evaluation& evaluation);

/// What `gnomon evaluate --check` prints, with a final newline.
[[nodiscard]] std::string check_text(const analysis::ImportCheck& check);

} // namespace gnomon::reports
