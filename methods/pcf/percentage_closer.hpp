#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// Percentage-closer filtering with kernels of any radius (Reeves, Salesin and Cook 1987): the mean
/// of the comparisons with texels that lie on a grid, a Poisson disc's or a spiral's places.
[[nodiscard]] Method percentage_closer();

} // namespace gnomon::methods
