#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string_view>

namespace gnomon::cli {

/// A file of the capture kit, as it is in the source.
struct KitFile {
    std::string_view name;
    std::string_view text;
};
[[nodiscard]] std::span<const KitFile> capture_kit_files();

/// `gnomon capture-kit DIR`: writes what an engine needs to make a case for `gnomon evaluate`.
void add_capture_kit_command(CLI::App& program);

} // namespace gnomon::cli
