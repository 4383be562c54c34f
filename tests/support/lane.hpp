#pragma once

#include <cstdlib>

namespace gnomon::tests {

/// Whether the full lane runs, which tries every case, and not the usual one, which tries a
/// selection.
[[nodiscard]] inline bool runs_full_tests()
{
    return std::getenv("GNOMON_FULL_TESTS") != nullptr;
}

/// What a test tries in the usual lane, or in the full one.
template <typename T>
[[nodiscard]] T in_lane(T usual, T full)
{
    return runs_full_tests() ? full : usual;
}

} // namespace gnomon::tests
