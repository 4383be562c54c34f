#include "store/run/run_record.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::store {

namespace {

using analysis::Environment;
using sqlite::Database;
using sqlite::Statement;

constexpr std::array<std::pair<std::string_view, std::string Environment::*>, 4>
    environment_columns{{{"gl_renderer", &Environment::gl_renderer},
                         {"gl_version", &Environment::gl_version},
                         {"embree", &Environment::embree},
                         {"gnomon", &Environment::gnomon}}};

Environment environment_of(Statement& row)
{
    Environment environment;
    int column = 0;
    for (const auto& [name, member] : environment_columns) {
        environment.*member = row.text(column++);
    }
    return environment;
}

std::int64_t read_integer(const Database& database, std::string_view key)
{
    Statement find{database, "SELECT value FROM run WHERE key = ?"};
    return find.bind(1, key).first().value_or(0);
}

std::string read_text(const Database& database, std::string_view key)
{
    Statement find{database, "SELECT value FROM run WHERE key = ?"};
    return find.bind(1, key).step() ? find.text(0) : std::string{};
}

/// The strings of a JSON array; empty if the value is not one.
std::vector<std::string> read_texts(const Database& database, std::string_view key)
{
    const Json texts = Json::parse(read_text(database, key), nullptr, false);
    const auto is_text = [](const Json& text) { return text.is_string(); };
    return texts.is_array() && std::ranges::all_of(texts, is_text)
               ? texts.get<std::vector<std::string>>()
               : std::vector<std::string>{};
}

} // namespace

std::int64_t record_environment(const Database& database, const Environment& environment)
{
    Statement insert{database, "INSERT OR IGNORE INTO environments"
                               " (gl_renderer, gl_version, embree, gnomon) VALUES (?, ?, ?, ?)"};
    Statement find{database, "SELECT number FROM environments WHERE gl_renderer = ?"
                             " AND gl_version = ? AND embree = ? AND gnomon = ?"};
    int parameter = 1;
    for (const auto& [name, member] : environment_columns) {
        insert.bind(parameter, std::string_view{environment.*member});
        find.bind(parameter++, std::string_view{environment.*member});
    }
    insert.run();
    return find.first().value_or(0); // the row exists now
}

std::string environment_text(const Environment& environment)
{
    return fmt::format("{}, GL {}, {}, {}", environment.gl_renderer, environment.gl_version,
                       environment.embree, environment.gnomon);
}

analysis::Environment find_environment(const Database& database, std::int64_t number)
{
    Statement find{database, "SELECT gl_renderer, gl_version, embree, gnomon FROM environments"
                             " WHERE number = ?"};
    return find.bind(1, number).step() ? environment_of(find) : Environment{};
}

void require_one_environment(const Database& database, const Environment& here)
{
    Statement others{database,
                     "SELECT gl_renderer, gl_version, embree, gnomon FROM environments e WHERE"
                     " number <> ? AND EXISTS"
                     " (SELECT 1 FROM configurations WHERE environment = e.number)"};
    if (!others.bind(1, record_environment(database, here)).step()) {
        return;
    }
    const Environment there = environment_of(others);
    for (const auto& [name, member] : environment_columns) {
        if (here.*member != there.*member) {
            throw scene::InputError(scene::one_line(fmt::format(
                "{}: its results come from another environment, {} was \"{}\" and is \"{}\": name "
                "another folder, or pass --allow-mixed",
                database.path().string(), name, there.*member, here.*member)));
        }
    }
}

void add_notes(std::vector<RunNote>& notes, const std::string& scene,
               std::span<const scene::SceneNote> of_scene, std::uint64_t configurations)
{
    for (const scene::SceneNote& note : of_scene) {
        const auto known = std::ranges::find_if(notes, [&](const RunNote& of_run) {
            return of_run.scene == scene && of_run.note == note;
        });
        if (known == notes.end()) {
            notes.push_back({scene, note, configurations});
        } else {
            known->configurations += configurations;
        }
    }
}

std::string notes_json(std::span<const RunNote> notes)
{
    Json json = Json::array();
    for (const RunNote& of_run : notes) {
        json.push_back({{"scene", of_run.scene},
                        {"kind", of_run.note.kind},
                        {"count", of_run.note.count},
                        {"text", of_run.note.text},
                        {"configurations", of_run.configurations}});
    }
    return json_text(json, -1);
}

std::vector<RunNote> read_notes(const std::string& json)
{
    std::vector<RunNote> notes;
    const Json all = Json::parse(json, nullptr, false);
    if (!all.is_array()) {
        return notes;
    }
    for (const Json& one : all) {
        try {
            notes.push_back(
                {one.at("scene").get<std::string>(),
                 {one.at("kind").get<std::string>(), one.at("count").get<std::uint64_t>(),
                  one.at("text").get<std::string>()},
                 one.at("configurations").get<std::uint64_t>()});
        } catch (const Json::exception&) {
            continue; // results do not depend on notes
        }
    }
    return notes;
}

std::vector<std::string> note_sentences(const RunDescription& description)
{
    const auto& notes = description.notes;
    const bool has_several_scenes = std::ranges::any_of(
        notes, [&](const RunNote& note) { return note.scene != notes.front().scene; });
    std::vector<std::string> sentences;
    for (const RunNote& of_run : notes) {
        std::string text = has_several_scenes ? of_run.scene + ": " : std::string{};
        text += of_run.note.text;
        if (of_run.configurations < description.size) {
            text += fmt::format(" (in {} of {})", scene::grouped(of_run.configurations),
                                scene::counted(description.size, "configuration"));
        }
        sentences.push_back(std::move(text));
    }
    return sentences;
}

RunDescription read_description(const Database& database)
{
    RunDescription description;
    description.environment = find_environment(database, environment_number(database));
    description.shard = {static_cast<std::uint32_t>(read_integer(database, "shard_index")),
                         static_cast<std::uint32_t>(read_integer(database, "shard_count"))};
    description.size = static_cast<std::uint64_t>(read_integer(database, "size"));
    description.axes = read_axes(database);
    description.lights = read_texts(database, "lights");
    description.job = read_text(database, "job");
    description.command = read_text(database, "command");
    description.compare_command = read_text(database, "compare_command");
    description.notes = read_notes(read_text(database, "notes"));
    return description;
}

std::vector<std::string> read_axes(const Database& database)
{
    return read_texts(database, "axes");
}

std::vector<std::string> read_engine_keys(const Database& database)
{
    return read_texts(database, "engine_keys");
}

std::int64_t environment_number(const Database& database)
{
    return read_integer(database, "environment");
}

} // namespace gnomon::store
