#include "cli/options/output_files.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

namespace gnomon::cli {
namespace {

bool are_same_file(const std::string& a, const std::string& b)
{
    std::error_code unreachable; // `require_writable` reports it later
    return !a.empty() && !b.empty() &&
           std::filesystem::weakly_canonical(a, unreachable) ==
               std::filesystem::weakly_canonical(b, unreachable) &&
           !unreachable;
}

/// Requires that no output would replace another, or an input.
void require_distinct(std::span<const OutputOption> outputs, std::span<const InputFile> inputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const OutputOption& other : outputs.subspan(i + 1)) {
            if (are_same_file(outputs[i].path, other.path)) {
                throw scene::InputError(fmt::format("{} and {} name the same file: name two",
                                                    outputs[i].option, other.option));
            }
        }
        for (const InputFile& input : inputs) {
            if (are_same_file(outputs[i].path, input.path)) {
                throw scene::InputError(
                    fmt::format("{}: is both {} and output: name another output",
                                scene::one_line(outputs[i].path), input.word));
            }
        }
    }
}

} // namespace

void require_outputs(std::span<const OutputOption> outputs, std::span<const InputFile> inputs)
{
    require_distinct(outputs, inputs);
    for (const OutputOption& output : outputs) {
        if (!output.path.empty()) {
            store::require_output_name(output.path, output.kind);
            store::require_writable(output.path);
        }
    }
}

void announce_output(std::string_view command, const std::filesystem::path& path)
{
    fmt::print(stderr, "gnomon {}: wrote {}\n", command, scene::one_line(path.string()));
}

void require_absent(const std::filesystem::path& path, bool may_replace, std::string_view remedy)
{
    std::error_code unreachable; // writing reports it
    const auto status = std::filesystem::status(path, unreachable);
    if (!may_replace && std::filesystem::exists(status) && !std::filesystem::is_other(status)) {
        throw scene::InputError(
            fmt::format("{}: the file exists: {}, or pass --force to replace it",
                        scene::one_line(path.string()), remedy));
    }
}

} // namespace gnomon::cli
