#pragma once

#include "analysis/evaluate/import_mistake.hpp"
#include "scene/vec.hpp"

#include <optional>
#include <span>

namespace gnomon::analysis {

/// The mistake of a position that a hundredth of the points or more share, bit by bit, as a cleared
/// background does; empty if there is no such position.
///
/// Where float32 is coarse for a camera neighbours repeat each other too, but all to about the same
/// number: no position stands out by a factor of ten.
[[nodiscard]] std::optional<ImportMistake>
check_shared_position(std::span<const scene::Vec3d> points);

} // namespace gnomon::analysis
