#pragma once

#include "scene/job/source.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// `read_job_source` of a file whose text is known already, as that of a planned sweep is.
/// @param path  where the file was: what it names is relative to its folder. Of a scene file,
///              which has no text, it is the scene itself.
/// @throws InputError  as `read_job_source`, but for reading the job file.
[[nodiscard]] JobSource job_source_of_text(const std::filesystem::path& path, std::string_view text,
                                           const std::vector<Override>& overrides,
                                           std::string_view preset = {});

} // namespace gnomon::scene
