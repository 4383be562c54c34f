#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// Percentage-closer soft shadows (Fernando 2005): what blocks about the receiver says how wide the
/// light's penumbra is there, and that is the radius of the mean of comparisons.
[[nodiscard]] Method percentage_closer_soft_shadows();

} // namespace gnomon::methods
