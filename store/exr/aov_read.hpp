#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace gnomon::store {

/// What a file of `write_aov` says of the truth.
struct Aov {
    /// The header's texts that begin with "gnomon:", by their names without it: "eye", "job", ….
    std::map<std::string, std::string> texts;
    scene::Image<scene::PixelClass> pixel_class;
    scene::Image<float> truth;           ///< 1 lit, 0 blocked, −1 not scored, as the file says
    scene::Image<std::uint32_t> prim;    ///< GL's triangle, or `scene::no_triangle`
    scene::Image<std::uint32_t> witness; ///< a triangle that blocks, or `scene::no_triangle`
    scene::Image<scene::Vec3f> position; ///< P; not a number where there is no receiver
};

/// Reads the channels `class`, `truth`, `prim`, `witness` and `P` by their names, and the header's
/// texts.
///
/// The file may be hostile: its header is checked before anything is decoded or memory taken.
/// @param image  the size that it must have.
/// @param light  Whose channels and texts of a file of several lights; one of a single light has
///               but its own.
/// @throws scene::InputError  one line: missing, no EXR file of scanlines, of another size, a
///                            channel that is missing or of another type, truncated, or a class
///                            code beyond 6.
[[nodiscard]] Aov read_aov(const std::filesystem::path& path, scene::ImageSize image,
                           const std::string& light = {});

} // namespace gnomon::store
