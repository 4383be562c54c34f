#pragma once

#include <string_view>

namespace gnomon::cli {

/// The text of reports/figures/figures.json, the list that make.py draws from; built in, so that
/// the figures can be named where there is no Python.
extern const std::string_view figure_list;

} // namespace gnomon::cli
