#pragma once

#include "scene/job/job.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// Memory that a map takes [bytes]; u-formats as if GL had them.
[[nodiscard]] std::uint64_t map_bytes(const scene::ShadowMapSettings& map);

/// Texels that a lookup reads; what GL's own filters read in one call counts, too.
[[nodiscard]] int tap_count(scene::Filter filter);

} // namespace gnomon::analysis
