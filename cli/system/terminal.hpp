#pragma once

namespace gnomon::cli {

/// Whether text on stdout may have colours: it goes to a terminal, TERM is not "dumb", and
/// NO_COLOR is unset or empty (https://no-color.org).
[[nodiscard]] bool stdout_has_colours();

} // namespace gnomon::cli
