#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "cli/renderer/protocol/renderer_requests.hpp"
#include "scene/light/light.hpp"

#include <filesystem>
#include <vector>

namespace gnomon::cli {

/// What an engine's documentation recommends of its keys under a type of light: `engine` of the
/// table `[documented]` of a league.toml, and over it the table of that light.
/// @param description  the file; empty, or none: nothing is recommended.
/// @throws scene::InputError  naming the file and the key, where it is not as it should be.
/// Source: docs/league.md#entering-an-engine.
[[nodiscard]] EngineValues documented_values(const std::filesystem::path& description,
                                             scene::LightType light,
                                             const std::vector<EngineKey>& keys);

} // namespace gnomon::cli
