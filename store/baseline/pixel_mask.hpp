#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/new_pixels.hpp"
#include "scene/error.hpp"
#include "scene/image.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::store {

/// A baseline, or a mask that it names, does not exist (exit code 3).
class BaselineMissing : public scene::InputError {
public:
    using InputError::InputError;
};

/// The folder beside a baseline that holds the masks of wrong pixels: FILE.masks. A mask is a PNG
/// image with one grey channel: 255 wrong, 0 not wrong. Its name is a hash of size and pixels.
[[nodiscard]] std::filesystem::path masks_folder(const std::filesystem::path& baseline);

/// 16 hexadecimal digits that depend on the pixels, not on their compression. The hash is not
/// cryptographic.
[[nodiscard]] std::string mask_name(const analysis::PixelMask& mask);
/// Whether the text is 16 lower-case hexadecimal digits.
[[nodiscard]] bool is_mask_name(std::string_view text);

/// Writes the mask under its name.
/// @return  The name.
/// @throws scene::EnvironmentError  if the mask cannot be written.
std::string write_mask(const std::filesystem::path& baseline, const analysis::PixelMask& mask);

/// Reads a mask. The file may be hostile: its size is checked before anything is decoded or
/// allocated.
/// @param size  of the configuration's image, which the mask must have.
/// @throws BaselineMissing    if the file does not exist.
/// @throws scene::InputError  if the file is not such an image, is damaged, has another size, or
///                            its name does not match its pixels.
[[nodiscard]] analysis::PixelMask read_mask(const std::filesystem::path& baseline,
                                            const std::string& name, scene::ImageSize size);

/// The size of a configuration's images in a baseline.
/// @throws scene::InputError  if the parameters hold no valid size.
[[nodiscard]] scene::ImageSize image_size_of(const analysis::GateEntry& entry);

/// Checks every mask that the baseline names.
/// @throws  as `read_mask`; also if a mask's pixel count differs from the metrics.
void require_masks(const std::filesystem::path& baseline, const analysis::GateEntries& entries);

/// Removes masks that an older baseline left and this one does not name.
void remove_other_masks(const std::filesystem::path& baseline,
                        const analysis::GateEntries& entries);

} // namespace gnomon::store
