#pragma once

#include "store/run/run_status.hpp"

#include <cstdint>
#include <string>

namespace gnomon::reports {

/// Advice for failed configurations that would fail again if retried.
[[nodiscard]] std::string useless_retry_text(std::uint64_t count);

/// The text that `gnomon status` prints, with a final newline.
[[nodiscard]] std::string run_status_text(const store::RunStatus& status);
/// The JSON that `gnomon status --json` prints (docs/runs.md).
[[nodiscard]] std::string run_status_json(const store::RunStatus& status);

} // namespace gnomon::reports
