#pragma once

#include "store/run/run_types.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::store {

/// Adds notes on a scene that concern so many configurations; a note that is there already gains
/// that number.
void add_notes(std::vector<RunNote>& notes, const std::string& scene,
               std::span<const scene::SceneNote> of_scene, std::uint64_t configurations);

/// A run's notes as it keeps them: a JSON array.
[[nodiscard]] std::string notes_json(std::span<const RunNote> notes);
/// The same read back; what is no note is passed over.
[[nodiscard]] std::vector<RunNote> read_notes(const std::string& json);

/// As people read them: with the scene's name where there are several, and with the number of
/// configurations where it is not all of them.
[[nodiscard]] std::vector<std::string> note_sentences(const RunDescription& description);

} // namespace gnomon::store
