#pragma once

#include "reports/settings/settings_text.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace gnomon::analysis {
struct Comparison;
}

namespace gnomon::cli {

/// Adds --engine.
/// @param what  what the option does; the names follow.
CLI::Option* add_engine_option(CLI::App& command, std::string& engine, std::string_view what);

/// The engine, shader language or graphics API that --engine names.
/// @throws scene::InputError  for an unknown name.
[[nodiscard]] reports::SettingsTarget engine_target(const std::string& engine);
/// The same for a command that prints settings besides its own result.
/// @return  Empty if --engine is not given.
/// @throws scene::InputError  also with --json, which has no place for them.
[[nodiscard]] std::optional<reports::SettingsTarget> engine_target(const std::string& engine,
                                                                   bool is_json);

/// Which bias of a job an engine gets.
enum class EngineBias : std::uint8_t {
    own,         ///< the job's
    recommended, ///< the recommended constant bias in place of the job's
    found,       ///< the job's, which a search found and recommends
};

/// Comparisons in an engine's settings, as far as the engine can have them.
class Translations {
public:
    Translations(reports::SettingsTarget target, EngineBias bias);
    Translations(const Translations&) = delete; // the settings point to the target
    Translations& operator=(const Translations&) = delete;

    /// Translates a comparison, or notes why the engine cannot have it.
    /// @param light  its name; empty for the only one.
    /// @param label  what notes call it: "light sun"; may be empty.
    /// @return  The translation, valid until the next call; null if the engine cannot have it.
    reports::TranslatedSettings* add(const analysis::Comparison& comparison,
                                     const std::string& light, const std::string& label);
    void add(const analysis::Comparison& comparison, const std::string& light)
    {
        add(comparison, light, light.empty() ? light : "light " + light);
    }

    [[nodiscard]] const std::vector<reports::TranslatedSettings>& all() const
    {
        return translated_;
    }
    /// Why the last of those left out has no settings. Precondition: one was left out.
    [[nodiscard]] const std::string& last_reason() const { return last_reason_; }
    /// Prints the settings after an empty line, and `print_notes`.
    void print(std::string_view command) const;
    /// Prints on stderr what was left out, and why.
    void print_notes(std::string_view command) const;

private:
    reports::SettingsTarget target_;
    EngineBias bias_;
    std::vector<reports::TranslatedSettings> translated_;
    std::vector<std::string> notes_;
    std::string last_reason_;
};

} // namespace gnomon::cli
