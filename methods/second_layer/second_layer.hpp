#pragma once

#include "methods/method.hpp"

namespace gnomon::methods {

/// Shadow maps of two layers: compared is the middle between the two surfaces that the light sees
/// first (Woo 1992), the second of them (Wang and Molnar 1994), or what lies between them, but no
/// farther than a bias behind the first (Weiskopf and Ertl 2003).
[[nodiscard]] Method second_layer_map();

} // namespace gnomon::methods
