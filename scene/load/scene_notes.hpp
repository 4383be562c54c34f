#pragma once

#include "scene/geometry/file_contents.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

struct Job;
struct SceneDefaults;
struct TriangleScene;

/// Something to know of a scene before its numbers are believed.
struct SceneNote {
    std::string kind; ///< a word of docs/json_schema.md#scene-notes, which never changes
    std::uint64_t count = 0;
    std::string text; ///< a sentence without capital and full stop

    friend bool operator==(const SceneNote&, const SceneNote&) = default;
};

/// Which of the two a comparison leaves to the scene's file.
struct LeftToFile {
    bool camera = false;
    bool light = false;

    friend auto operator<=>(const LeftToFile&, const LeftToFile&) = default;
};
[[nodiscard]] LeftToFile left_to_file(const Job& job);

/// What is to be said of a scene as it is compared: what its file gave, and what of the file is
/// left out or taken for something else. Empty for a scene that is compared just as it is.
[[nodiscard]] std::vector<SceneNote> scene_notes(const TriangleScene& scene,
                                                 const SceneDefaults& defaults, LeftToFile left);

/// What is to be said of an object that encloses the light, as a comparison finds it.
[[nodiscard]] SceneNote enclosed_light_note(const std::string& object);

} // namespace gnomon::scene
