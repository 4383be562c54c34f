#include "scene/job/presets/presets.hpp"

#include "generated_document.hpp"
#include "methods/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {
namespace {

constexpr const char* presets_document = GNOMON_ROOT "/docs/presets.md";

std::string keys_of_layer(const Layer& layer)
{
    std::vector<std::string> keys;
    for (const Setting& setting : layer) {
        keys.push_back(fmt::format("`{} = {}`", setting.spec->name, to_toml(setting.value)));
    }
    return fmt::format("{}", fmt::join(keys, ", "));
}

std::string lights_of(const Preset& preset)
{
    std::vector<std::string_view> names;
    for (const LightType light : preset.lights) {
        names.push_back(light_type_name(light));
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string overview(PresetKind kind)
{
    std::string text = "| preset | what it is | lights | its bias, in its own units |\n"
                       "|---|---|---|---|\n";
    for (const Preset& preset : presets(*methods::key_table())) {
        if (preset.kind == kind) {
            text += fmt::format("| [`{0}`](#{0}) | {1} | {2} | {3} |\n", preset.name,
                                preset.sentence, lights_of(preset), preset.own_bias);
        }
    }
    return text;
}

std::string default_text(const EngineSetting& setting)
{
    if (!setting.own_default) {
        return "";
    }
    const auto* number = std::get_if<double>(&*setting.own_default);
    return number != nullptr ? fmt::format("{:g}", *number)
                             : fmt::format("`{}`", std::get<std::string>(*setting.own_default));
}

/// What `gnomon settings` gives a value to.
std::string settings_table(const std::string& name, const Engine& engine)
{
    const std::string aliases =
        engine.aliases.empty() ? "" : fmt::format(" (or `{}`)", fmt::join(engine.aliases, "`, `"));
    std::string text =
        fmt::format("\n`gnomon settings --engine {}`{} gives values to these, checked with "
                    "{} {} ([documented]({})):\n\n"
                    "| setting | of | times | own default | |\n|---|---|---|---|---|\n",
                    name, aliases, engine.title, engine.version, engine.documentation);
    for (const EngineSetting& setting : engine.settings) {
        const std::string second =
            setting.second_key == nullptr ? "" : fmt::format(", `{}`", setting.second_key->name);
        text += fmt::format("| `{}` | `{}`{} | {} | {} | {} |\n", setting.name, setting.key->name,
                            second, setting.words.empty() ? fmt::format("{:g}", setting.times) : "",
                            default_text(setting), setting.about);
    }
    return text;
}

std::string section(const Preset& preset)
{
    std::string text = fmt::format("### {}\n\n{}.\n\n", preset.name, preset.source);
    text += fmt::format("- keys: {}\n", keys_of_layer(preset.job));
    if (!preset.own_scene.empty()) {
        text += fmt::format("- with its own scene: {}\n", keys_of_layer(preset.own_scene));
    }
    text += "- what a job cannot express:\n";
    for (const std::string& line : preset.cannot) {
        text += fmt::format("  - {}\n", line);
    }
    return preset.engine ? text + settings_table(preset.name, *preset.engine) : text;
}

std::string sections()
{
    std::string text;
    for (const Preset& preset : presets(*methods::key_table())) {
        text += (text.empty() ? std::string{} : std::string{"\n"}) + section(preset);
    }
    return text;
}

/// Replaces the text between the markers of this name.
std::string with_text(std::string page, std::string_view name, const std::string& text)
{
    const std::string begin = fmt::format("<!-- {}: generated -->\n", name);
    const auto start = page.find(begin);
    const auto end = page.find("<!-- end -->", start);
    if (start == std::string::npos || end == std::string::npos) {
        ADD_FAILURE() << presets_document << " has no place for " << name;
        return page;
    }
    const auto from = start + begin.size();
    return page.replace(from, end - from, fmt::format("\n{}\n", text));
}

TEST(PresetsDocument, HasTheTablesOfThePresets)
{
    std::string expected =
        with_text(tests::read_text(presets_document), "lessons", overview(PresetKind::lesson));
    expected = with_text(std::move(expected), "engines", overview(PresetKind::engine));
    expected = with_text(std::move(expected), "presets", sections());
    tests::expect_document(presets_document, expected, "methods_tests");
}

} // namespace
} // namespace gnomon::scene
