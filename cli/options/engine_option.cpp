#include "cli/options/engine_option.hpp"

#include "analysis/comparison/comparison.hpp"
#include "cli/system/process.hpp"
#include "methods/key_table.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <utility>
#include <variant>

namespace gnomon::cli {

CLI::Option* add_engine_option(CLI::App& command, std::string& engine, std::string_view what)
{
    return command.add_option(
        "--engine", engine,
        fmt::format("{}: {}", what, fmt::join(reports::settings_target_names(), ", ")));
}

reports::SettingsTarget engine_target(const std::string& engine)
{
    return reports::find_settings_target(*methods::key_table(), engine, "--engine " + engine);
}

std::optional<reports::SettingsTarget> engine_target(const std::string& engine, bool is_json)
{
    if (engine.empty()) {
        return std::nullopt;
    }
    if (is_json) {
        throw scene::InputError("--engine and --json are mutually exclusive: `gnomon settings "
                                "--json` prints an engine's settings as JSON");
    }
    return engine_target(engine);
}

Translations::Translations(reports::SettingsTarget target, EngineBias bias)
    : target_{std::move(target)},
      bias_{bias}
{
}

reports::TranslatedSettings* Translations::add(const analysis::Comparison& comparison,
                                               const std::string& light, const std::string& label)
{
    try {
        translated_.push_back(
            reports::translate(target_, comparison, bias_ == EngineBias::recommended));
    } catch (const scene::InputError& error) { // another light may have settings
        last_reason_ = error.what();
        notes_.push_back(label.empty() ? last_reason_ : fmt::format("{}: {}", label, last_reason_));
        return nullptr;
    }
    const auto name = [&](analysis::ChosenBias& settings) {
        settings.light = light;
        settings.is_recommended = settings.is_recommended || bias_ == EngineBias::found;
    };
    std::visit(name, translated_.back().settings);
    return &translated_.back();
}

void Translations::print(std::string_view command) const
{
    if (!translated_.empty()) {
        cli::print("\n" + reports::settings_text(translated_));
    }
    print_notes(command);
}

void Translations::print_notes(std::string_view command) const
{
    for (const std::string& note : notes_) {
        fmt::print(stderr, "gnomon {}: note: {}\n", command, note);
    }
}

} // namespace gnomon::cli
