#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gnomon::reports {

/// Text of base64, RFC 4648, with its padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

} // namespace gnomon::reports
