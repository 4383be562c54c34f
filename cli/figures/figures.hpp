#pragma once

#include "scene/error.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// Debian's Python, whose packages are known.
inline constexpr const char* system_python = "/usr/bin/python3";

/// Python or a package for figures is missing; `what()` says how to get it.
class PythonMissing : public scene::EnvironmentError {
public:
    using EnvironmentError::EnvironmentError;
};

/// A figure that `gnomon figure NAME` draws.
struct FigureKind {
    std::string name;
    std::string input; ///< "RUN" or "CSV"
    std::string description;
};

/// Every figure, those of a run first.
[[nodiscard]] std::span<const FigureKind> figure_kinds();

/// A figure of a run, as two files, and its texts.
struct FigureFile {
    std::string name; ///< as in `figure_kinds`
    std::string title;
    std::string caption; ///< the settings
    std::string alt;     ///< a description with the main numbers, for blind readers
    std::string svg;     ///< file names in the folder
    std::string png;
};

/// Draws one figure.
///
/// @param inputs  A run's folder, or CSV files.
/// @param output  A path that ends in .pdf, .svg or .png.
/// @throws PythonMissing, scene::InputError (bad input, or the figure does not apply to the run),
///         scene::EnvironmentError (the output cannot be written).
void draw_figure(const std::string& name, const std::vector<std::string>& inputs,
                 const std::string& output, const std::string& python = system_python);

/// Draws every figure that applies to a run, from its CSV files; creates the folder.
///
/// @throws as `draw_figure`.
[[nodiscard]] std::vector<FigureFile> draw_run_figures(const std::filesystem::path& run,
                                                       const std::filesystem::path& folder,
                                                       const std::string& python = system_python);

/// The text of reports/figures/figures.json, built in so that figures can be listed without Python.
extern const std::string_view figure_list;

} // namespace gnomon::cli
