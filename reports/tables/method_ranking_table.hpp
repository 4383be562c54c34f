#pragma once

#include "analysis/tune/tune.hpp"

#include <string>

namespace gnomon::reports {

/// What a search over methods found of each, the least wrong first; what it set of their keys, and
/// which it passed over.
/// @param result      with `methods`.
/// @param tells_all   Every setting that was tried, and every one that was refused.
[[nodiscard]] std::string methods_text(const analysis::TuneResult& result, bool tells_all);

} // namespace gnomon::reports
