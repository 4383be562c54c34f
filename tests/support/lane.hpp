#pragma once

#include <cstdlib>

namespace gnomon::tests {

/// Whether the full lane runs, which tries every case. The usual lane tries a selection.
[[nodiscard]] inline bool runs_full_tests()
{
    return std::getenv("GNOMON_FULL_TESTS") != nullptr;
}

template <typename T>
[[nodiscard]] T in_lane(T usual, T full)
{
    return runs_full_tests() ? full : usual;
}

} // namespace gnomon::tests
