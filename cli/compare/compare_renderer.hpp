#pragma once

#include "cli/compare/compare_options.hpp"
#include "cli/renderer/renderer_command.hpp"

namespace gnomon::cli {

/// `gnomon compare` of what another renderer draws: started, asked for one frame, which is judged
/// as `gnomon evaluate` judges a case.
/// @throws scene::InputError  for options that are about GL's own shadows, and as
///                            `RendererSession`.
void compare_renderer(const CompareOptions& options, RendererCommand command);

} // namespace gnomon::cli
