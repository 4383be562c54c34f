#pragma once

#include <span>
#include <string_view>

namespace gnomon::cli {

/// A file of the capture kit, built in.
struct KitFile {
    std::string_view name;
    std::string_view text;
};
[[nodiscard]] std::span<const KitFile> capture_kit_files();

} // namespace gnomon::cli
