#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// The manual page gnomon(1), for man(1), made from the program's own commands and options.
[[nodiscard]] std::string manual_page(const CLI::App& program);

/// The same as Markdown: docs/commands.md.
[[nodiscard]] std::string manual_markdown(const CLI::App& program);

} // namespace gnomon::cli
