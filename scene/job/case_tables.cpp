#include "scene/error.hpp"
#include "scene/job/setting_layers.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::scene {
namespace {

CaseLayer read_case(const KeyTable& keys, const TomlNode& node, const std::string& file,
                    std::uint32_t line)
{
    const auto* table = std::get_if<TomlTable>(&node.value);
    const std::string label = KeyPlace{file, line}.text() + "[[case]]";
    if (table == nullptr) {
        throw InputError(label + ": must be a table with a name and any keys");
    }
    CaseLayer read;
    TomlTable given;
    for (const TomlMember& member : *table) {
        if (member.key != "name") {
            given.push_back(member);
            continue;
        }
        const auto name = read_value(TextDomain{}, member.node);
        if (!name) {
            throw InputError(fmt::format("{}:{}: [[case]] name = {}: must be {}", file, member.line,
                                         toml_excerpt(member.node), range_text(TextDomain{})));
        }
        read.name = std::get<std::string>(*name);
    }
    if (read.name.empty()) {
        throw InputError(label + ": has no name; give it a name of its own");
    }
    const std::string quoted = toml_excerpt({read.name});
    read.layer =
        layer_from_table(keys, given, file, fmt::format("[[case]] {}: ", quoted), {"name"});
    return read;
}

} // namespace

std::vector<CaseLayer> read_cases(const KeyTable& keys, const TomlMember& member,
                                  const std::string& file)
{
    const auto* array = std::get_if<TomlArray>(&member.node.value);
    if (array == nullptr) {
        throw InputError(
            fmt::format("{}:{}: case: must be tables, each headed [[case]]", file, member.line));
    }
    std::vector<CaseLayer> result;
    for (const TomlNode& node : *array) {
        result.push_back(read_case(keys, node, file, member.line));
    }
    std::vector<std::string> names;
    for (const CaseLayer& read : result) {
        names.push_back(read.name);
    }
    std::sort(names.begin(), names.end());
    const auto repeated = std::adjacent_find(names.begin(), names.end());
    if (repeated != names.end()) {
        throw InputError(
            fmt::format("{}:{}: [[case]] name = {}: two cases of that name; rename one", file,
                        member.line, toml_excerpt({*repeated})));
    }
    return result;
}

} // namespace gnomon::scene
