#pragma once

#include "api/scene_session.hpp"

namespace CLI {
class App;
}

namespace gnomon::cli {

/// Adds --device and --threads.
void add_session_options(CLI::App& command, api::SessionOptions& options);

} // namespace gnomon::cli
