#include "cli/runs/run_ending.hpp"

#include "cli/exit_codes.hpp"

#include <CLI/CLI.hpp>

namespace gnomon::cli {

void end_as(const store::RunStatus& status)
{
    if (!status.is_complete()) {
        throw CLI::RuntimeError{exit_codes::incomplete};
    }
    if (!status.checks.are_passed()) {
        throw CLI::RuntimeError{exit_codes::environment_failed};
    }
}

} // namespace gnomon::cli
