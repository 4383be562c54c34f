#pragma once

#include "store/output_name.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// A file that an option names for a result; an empty path: it was not given.
struct OutputOption {
    std::string_view option;
    std::string path;
    store::OutputKind kind;
};

/// A file that is read, and what it is.
struct InputFile {
    std::string_view word; ///< "JOB"
    std::string path;      ///< empty: there is none
};

/// Refuses, before the work rather than after it, outputs that would replace each other or an
/// input, whose names say something else than they hold, or that cannot be written.
/// @throws scene::InputError        naming the option or the file.
/// @throws scene::EnvironmentError  if one cannot be written.
void require_outputs(std::span<const OutputOption> outputs, std::span<const InputFile> inputs);

/// Refuses a file or folder that stands where another is to be written, unless it may be replaced.
/// @param remedy  what to do instead of passing --force: "name another".
/// @throws scene::InputError
void require_absent(const std::filesystem::path& path, bool may_replace, std::string_view remedy);

} // namespace gnomon::cli
