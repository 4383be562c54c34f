#include "cli/options/session_options.hpp"

#include <CLI/CLI.hpp>

namespace gnomon::cli {

void add_session_options(CLI::App& command, api::SessionOptions& options)
{
    command.add_option(
        "--device", options.device,
        "EGL device, as `gnomon doctor` numbers them; default: the first that works");
    command.add_option("--threads", options.threads, "Threads of the reference; 0: all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

} // namespace gnomon::cli
