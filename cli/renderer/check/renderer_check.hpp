#pragma once

#include "cli/renderer/protocol/renderer_client.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// What came of trying a renderer against a rule of docs/renderer_protocol.md.
struct RuleFinding {
    std::string rule; ///< "open", "same frame", …
    bool is_kept = true;
    std::string sentence; ///< what was seen
};

/// Starts a renderer and tries it against every rule, on a small scene of its own. A renderer that
/// fails is started again for the rules that are left; those that make no sense without an earlier
/// one are left out.
/// @param parent   of its files, as `RendererClient`.
/// @param longest  for each answer.
/// @throws scene::EnvironmentError  if not the renderer but the machine fails.
[[nodiscard]] std::vector<RuleFinding> check_renderer(const RendererCommand& command,
                                                      const std::filesystem::path& parent,
                                                      RendererClient::Seconds longest);

} // namespace gnomon::cli
