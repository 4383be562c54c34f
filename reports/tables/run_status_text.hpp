#pragma once

#include "store/run/run_status.hpp"

#include <cstdint>
#include <string>

namespace gnomon::reports {

/// What to do about failed configurations that fail again whenever they are tried.
[[nodiscard]] std::string useless_retry_text(std::uint64_t count);

/// What `gnomon status` prints, with a final newline.
[[nodiscard]] std::string run_status_text(const store::RunStatus& status);
/// What `gnomon status --json` prints (docs/runs.md).
[[nodiscard]] std::string run_status_json(const store::RunStatus& status);

} // namespace gnomon::reports
