#pragma once

#include "methods/bias_term.hpp"
#include "methods/method.hpp"

namespace gnomon::methods {

/// Whether a job of the method that has all but a bias term at its defaults is refused for that
/// term: by the term, or by the method.
/// @param term  one of the method's.
/// @throws std::invalid_argument  if one of the term's own keys takes neither numbers nor words.
[[nodiscard]] bool refuses(const Method& method, const BiasTerm& term);

} // namespace gnomon::methods
