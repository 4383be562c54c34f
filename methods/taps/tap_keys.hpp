#pragma once

#include "methods/taps/tap_kernel.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/settings/job.hpp"

namespace gnomon::methods {

/// Keys of methods whose taps are scattered: how they lie, how many, what they weigh, whether
/// kernels are turned.
[[nodiscard]] const scene::Key& pattern_key();
[[nodiscard]] const scene::Key& taps_key();
[[nodiscard]] const scene::Key& turned_key();

/// What these keys of a job say.
[[nodiscard]] TapPattern tap_pattern(const scene::Job& job);
[[nodiscard]] int tap_count(const scene::Job& job);
[[nodiscard]] bool is_turned(const scene::Job& job);

/// The kernel that they say; in place of a grid that there is not, which `check_taps` refuses, the
/// smallest.
[[nodiscard]] const TapKernel& tap_kernel(const scene::Job& job, TapWeights weights);

/// @throws scene::InputError  where the job asks for a grid of a number of taps that is none.
void check_taps(const scene::Job& job);

} // namespace gnomon::methods
