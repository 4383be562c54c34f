#pragma once

#include "store/output_file.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// An output file and the option that names it.
struct OutputOption {
    std::string_view option;
    std::string path; ///< empty: not given
    store::OutputKind kind;
};

/// A file that is read.
struct InputFile {
    std::string_view word; ///< "JOB"
    std::string path;      ///< empty: not given
};

/// Checks outputs before the work begins: they must not replace each other or an input, their names
/// must suit their contents, and they must be writable.
/// @throws scene::InputError        naming the option or the file.
/// @throws scene::EnvironmentError  if one cannot be written.
void require_outputs(std::span<const OutputOption> outputs, std::span<const InputFile> inputs);

/// Says on stderr that an output file or folder was written: "gnomon compare: wrote shadows.png".
void announce_output(std::string_view command, const std::filesystem::path& path);

/// Requires that a file or folder does not exist yet, unless it may be replaced.
/// @param remedy  the alternative to --force, for the message: "name another".
/// @throws scene::InputError
void require_absent(const std::filesystem::path& path, bool may_replace, std::string_view remedy);

} // namespace gnomon::cli
