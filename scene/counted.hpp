#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::scene {

/// A count with its thousands grouped: "1,048,578".
[[nodiscard]] std::string grouped(std::uint64_t count);

/// Counts of `count` things: "1 triangle", "2,000 triangles".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view noun);

} // namespace gnomon::scene
