#include "scene/job/renderer_choice.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

namespace gnomon::scene {

bool is_scene_file(const std::filesystem::path& path)
{
    const std::string extension = lower_case(path.extension().string());
    constexpr std::array<std::string_view, 4> scene_extensions{".gltf", ".glb", ".obj", ".ply"};
    return std::find(scene_extensions.begin(), scene_extensions.end(), extension) !=
           scene_extensions.end();
}

namespace {

constexpr std::string_view no_commands =
    "a job file may not hold a command, because job files come from strangers: name an installed "
    "renderer with renderer = \"NAME\" (`gnomon renderers`), or pass --renderer-command";

bool is_name(std::string_view text)
{
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-' || c == '.';
    });
}

} // namespace

std::string renderer_of_job(const std::filesystem::path& path)
{
    std::error_code error;
    if (is_scene_file(path) || std::filesystem::is_fifo(path, error)) {
        return {};
    }
    const std::string source = one_line(path.string());
    for (const TomlMember& member : parse_toml(read_text_file(path, source, "job file"), source)) {
        refuse_renderer_command(member, source);
        if (member.key == renderer_key) {
            return read_renderer_choice(member, source);
        }
    }
    return {};
}

std::string read_renderer_choice(const TomlMember& member, const std::string& source)
{
    const auto* const name = std::get_if<std::string>(&member.node.value);
    if (name == nullptr || !is_name(*name)) {
        throw InputError(
            fmt::format("{}:{}: renderer = {}: must be a name of letters, digits, _, - "
                        "and .; {}",
                        source, member.line, toml_excerpt(member.node), no_commands));
    }
    return *name;
}

void refuse_renderer_command(const TomlMember& member, const std::string& source)
{
    if (member.key != renderer_key && member.key.starts_with(renderer_key)) {
        throw InputError(fmt::format("{}:{}: {}: {}", source, member.line,
                                     toml_excerpt({member.key}), no_commands));
    }
}

} // namespace gnomon::scene
