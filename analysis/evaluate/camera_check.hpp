#pragma once

#include "analysis/evaluate/checked_case.hpp"
#include "analysis/evaluate/import_mistake.hpp"
#include "renderers/reference.hpp"

#include <optional>

namespace gnomon::analysis {

/// The mistake of a case without positions whose camera is not the renderer's.
///
/// If mask and truth agree by less than 0.9, or the mask has values where the camera sees nothing,
/// other cameras are tried: with the opening angle taken for that of another side of the image, or
/// for half of it, and with other axes up. One is named that explains the mask far better. If none
/// does, the camera is named where the mask has values at more than a fiftieth of the pixels at
/// which the camera sees nothing.
/// @param checked  with its job, view and receivers.
/// @return  Empty if there is no such mistake, or if the case has positions.
[[nodiscard]] std::optional<ImportMistake>
check_other_cameras(const Case& subject, const CheckedCase& checked,
                    const renderers::RoundedReference& truth);

} // namespace gnomon::analysis
