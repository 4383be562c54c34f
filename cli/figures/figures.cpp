#include "cli/figures/figures.hpp"

#include "cli/exit_codes.hpp"
#include "cli/system/child_process.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <system_error>

namespace gnomon::cli {
namespace {

constexpr int module_missing = 3; ///< of make.py

std::vector<FigureKind> listed_figures()
{
    std::vector<FigureKind> kinds;
    for (const auto& figure : nlohmann::json::parse(figure_list)) {
        const bool is_of_a_run = figure.at("reads") != "tables";
        kinds.push_back({figure.at("name"), is_of_a_run ? "RUN" : "CSV", figure.at("shows")});
    }
    return kinds;
}

[[noreturn]] void throw_missing(const std::string& what)
{
    throw PythonMissing(fmt::format("{}; figures need Python with two packages (Debian: apt-get "
                                    "install python3-matplotlib python3-pandas)",
                                    what));
}

/// Beside the installed program, else in the source tree.
std::filesystem::path script()
{
    std::error_code none;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", none);
    auto installed = program.parent_path() / GNOMON_FIGURES_FROM_PROGRAM / "make.py";
    if (std::filesystem::exists(installed, none)) {
        return installed.lexically_normal();
    }
    std::filesystem::path source{GNOMON_FIGURES_IN_SOURCE "/make.py"};
    if (!std::filesystem::exists(source, none)) {
        throw scene::EnvironmentError(fmt::format("{}: no such file, nor {}; install Gnomon again",
                                                  installed.string(), source.string()));
    }
    return source;
}

/// The last line of stderr, without the script's name: there Python puts the error.
std::string reason(std::string text)
{
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    text.erase(0, text.rfind('\n') + 1);
    constexpr std::string_view prefix = "make.py: ";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

/// Runs make.py and returns its output.
std::string call_script(const std::string& python, const std::vector<std::string>& arguments)
{
    std::error_code none;
    if (!std::filesystem::exists(python, none)) {
        throw_missing(fmt::format("there is no {}", python));
    }
    // Ignore the user's environment and packages (-E, -s); write no bytecode (-B).
    std::vector<std::string> command{python, "-E", "-s", "-B", script().string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    CapturedEnding ending = run_captured(command);
    switch (ending.status) {
    case exit_codes::done:
        return std::move(ending.out);
    case exit_codes::bad_input:
        throw scene::InputError(reason(ending.err));
    case module_missing:
        throw_missing(reason(ending.err));
    case exit_codes::environment_failed:
        throw scene::EnvironmentError(reason(ending.err));
    default:
        throw scene::EnvironmentError(
            fmt::format("{} ended with {}: {}", command[4], ending.status, reason(ending.err)));
    }
}

/// The path as an argument that does not look like an option.
std::string operand(const std::filesystem::path& path)
{
    const std::string text = path.string();
    return text.starts_with('-') ? "./" + text : text;
}

} // namespace

std::span<const FigureKind> figure_kinds()
{
    static const std::vector<FigureKind> kinds = listed_figures();
    return kinds;
}

void draw_figure(const std::string& name, const std::vector<std::string>& inputs,
                 const std::string& output, const std::string& python)
{
    std::vector<std::string> arguments{operand(name), "-o", operand(output)};
    for (const std::string& input : inputs) {
        arguments.push_back(operand(input));
    }
    (void)call_script(python, arguments);
}

std::vector<FigureFile> draw_run_figures(const std::filesystem::path& run,
                                         const std::filesystem::path& folder,
                                         const std::string& python)
{
    const std::string printed =
        call_script(python, {"run", "--out", operand(folder), operand(run)});
    std::vector<FigureFile> figures;
    for (const auto& figure : nlohmann::json::parse(printed)) {
        figures.push_back({figure.at("name"), figure.at("title"), figure.at("caption"),
                           figure.at("alt"), figure.at("svg"), figure.at("png")});
    }
    return figures;
}

} // namespace gnomon::cli
