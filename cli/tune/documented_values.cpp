#include "cli/tune/documented_values.hpp"

#include "scene/error.hpp"
#include "scene/job/toml.hpp"
#include "scene/one_line.hpp"
#include "scene/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>

namespace gnomon::cli {
namespace {

/// The table of that name; nullptr: there is none.
const scene::TomlTable* find_table(const scene::TomlTable& table, std::string_view name)
{
    const auto found = std::ranges::find(table, name, &scene::TomlMember::key);
    return found == table.end() ? nullptr : std::get_if<scene::TomlTable>(&found->node.value);
}

void add_values(EngineValues& values, const scene::TomlTable& table,
                const std::vector<EngineKey>& keys, const std::string& source)
{
    for (const scene::TomlMember& member : table) {
        const auto key = std::ranges::find(keys, member.key, &EngineKey::name);
        const auto value =
            key == keys.end() ? std::nullopt : scene::read_value(key->domain, member.node);
        if (!value) {
            throw scene::InputError(fmt::format(
                "{}:{}: documented: {}: {}", source, member.line, scene::one_line(member.key),
                key == keys.end() ? "the engine has no such key"
                                  : scene::refusal_text(key->domain, member.node)));
        }
        values[member.key] = *value;
    }
}

} // namespace

EngineValues documented_values(const std::filesystem::path& description, scene::LightType light,
                               const std::vector<EngineKey>& keys)
{
    EngineValues values;
    std::error_code none;
    if (description.empty() || !std::filesystem::is_regular_file(description, none)) {
        return values;
    }
    const std::string source = scene::one_line(description.string());
    const scene::TomlTable file =
        scene::parse_toml(scene::read_text_file(description, source, "league.toml"), source);
    const scene::TomlTable* const documented = find_table(file, "documented");
    for (const std::string_view name :
         {std::string_view{"engine"}, scene::light_type_name(light)}) {
        const scene::TomlTable* const table =
            documented == nullptr ? nullptr : find_table(*documented, name);
        if (table != nullptr) {
            add_values(values, *table, keys, source);
        }
    }
    return values;
}

} // namespace gnomon::cli
