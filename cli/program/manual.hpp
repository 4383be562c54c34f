#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace gnomon::cli {

/// The manual page gnomon(1), for man(1), made from the program's own commands and options.
[[nodiscard]] std::string manual_page(const CLI::App& program);

/// The same as Markdown: docs/commands.md.
[[nodiscard]] std::string manual_markdown(const CLI::App& program);

/// `gnomon manual`.
void add_manual_command(CLI::App& program);

} // namespace gnomon::cli
