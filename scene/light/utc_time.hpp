#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace gnomon::scene {

using UtcTime = std::chrono::sys_time<std::chrono::milliseconds>;

/// "2026-06-21T12:00:00Z", also without seconds, with a fraction of them, or with an offset from
/// UTC in place of Z, "+02:00". Empty if the text is not such a time.
[[nodiscard]] std::optional<UtcTime> utc_time(std::string_view text);

} // namespace gnomon::scene
