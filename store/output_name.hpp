#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace gnomon::store {

/// What an output file holds.
enum class OutputKind : std::uint8_t {
    picture,
    layers,
    plot,
    figure,
    csv,
    junit,
    baseline,
    job,
};

/// Holds a file's name to what is written there. An image's or job's ending is its own, or there is
/// none (a device, a pipe); that of a plot or figure chooses the format, and must be there; other
/// texts may have any ending but one that stands for something else.
/// @throws scene::InputError  naming the path and the remedy.
void require_output_name(const std::filesystem::path& path, OutputKind kind);

} // namespace gnomon::store
