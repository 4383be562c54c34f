#pragma once

#include <cstdint>

namespace gnomon::store {

/// How many of its threads OpenEXR should take to compress or decompress an image: none for a small
/// one, which is done before they have started.
/// @param bytes  of the pixels, or of the file.
[[nodiscard]] int exr_threads(std::uint64_t bytes);

} // namespace gnomon::store
