#include "store/run/run_notes.hpp"

#include "scene/counted.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::store {

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
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
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
            continue; // a note says nothing that the results need
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

} // namespace gnomon::store
