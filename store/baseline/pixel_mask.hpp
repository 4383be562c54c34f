#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/new_pixels.hpp"
#include "scene/image.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::store {

/// Masks of wrong pixels stand beside a baseline, in the folder FILE.masks, as PNG images of one
/// grey channel: 255 wrong, 0 not. Their names are hashes of size and pixels.
[[nodiscard]] std::filesystem::path masks_folder(const std::filesystem::path& baseline);

/// 16 hexadecimal digits, the same for the same pixels, however they are compressed. They tell
/// contents apart, but do not resist somebody who wants two of the same hash.
[[nodiscard]] std::string mask_name(const analysis::PixelMask& mask);
/// Whether the text is 16 hexadecimal digits in small letters.
[[nodiscard]] bool is_mask_name(std::string_view text);

/// Writes the mask under its name, unless it stands there already.
/// @return  The name.
/// @throws scene::EnvironmentError  if it cannot be written.
std::string write_mask(const std::filesystem::path& baseline, const analysis::PixelMask& mask);

/// @param size  That it must have, by the job of the configuration.
/// @throws BaselineMissing    if there is no such file.
/// @throws scene::InputError  if it is no such image, damaged, of another size, or not what its
///                            name says. The file may be hostile: its size is checked before
///                            anything is decoded or memory taken.
[[nodiscard]] analysis::PixelMask read_mask(const std::filesystem::path& baseline,
                                            const std::string& name, scene::ImageSize size);

/// The size of a baseline's images of that configuration.
/// @throws scene::InputError  if its parameters do not give one.
[[nodiscard]] scene::ImageSize image_size_of(const analysis::GateEntry& entry);

/// Reads every mask that the baseline names.
/// @throws  as `read_mask`.
void require_masks(const std::filesystem::path& baseline, const analysis::GateEntries& entries);

/// Removes the masks that the baseline does not name: an older one left them.
void remove_other_masks(const std::filesystem::path& baseline,
                        const analysis::GateEntries& entries);

} // namespace gnomon::store
