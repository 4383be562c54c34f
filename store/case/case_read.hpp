#pragma once

#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"

#include <cstdint>

namespace gnomon::store {

/// Reads a case's image, and its shadow map if it names one, channels by name.
///
/// The files may be hostile: headers are checked before anything is decoded or memory taken.
/// @param memory_bytes  that may be taken; 0: unknown, no limit.
/// @throws scene::InputError  one line: what is wrong, in which channel, at which pixel, and what
///                            to do. Missing or of the wrong type, truncated, of several parts, too
///                            large, a mask that is NaN or beyond [0, 1], a position that is not
///                            finite where `valid` says that it is to be judged, nothing to judge.
[[nodiscard]] scene::CaseLayers read_case_layers(const scene::CaseFile& file,
                                                 std::uint64_t memory_bytes);

} // namespace gnomon::store
