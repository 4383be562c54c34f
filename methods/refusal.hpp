#pragma once

#include "methods/bias_term.hpp"
#include "methods/method.hpp"

namespace gnomon::methods {

/// Whether term or method refuse an otherwise default job of the method that sets this bias term.
/// @param term  one of the method's.
/// @throws std::invalid_argument  if one of the term's own keys accepts neither numbers nor words.
[[nodiscard]] bool refuses(const Method& method, const BiasTerm& term);

} // namespace gnomon::methods
