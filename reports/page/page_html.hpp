#pragma once

#include "store/json_values.hpp"

#include <span>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// A text in HTML, also within quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// The whole page: a head with a Content-Security-Policy that names its style and scripts alone,
/// the body, data and scripts.
/// @param blocks  the packed texts "b0", "b1", ….
[[nodiscard]] std::string whole_page(std::string_view title, std::string_view body,
                                     const store::Json& data, std::span<const std::string> blocks);

} // namespace gnomon::reports
