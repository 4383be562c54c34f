#pragma once

#include "methods/method.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// The methods, what each promises with each filter, its bias terms and its keys, as the aligned
/// text that `gnomon methods` prints.
[[nodiscard]] std::string methods_table(std::span<const methods::Method> methods);

} // namespace gnomon::reports
