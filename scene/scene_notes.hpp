#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

struct Job;
struct SceneDefaults;
struct TriangleScene;

/// What a scene file holds beside triangles: plain numbers, as the importing child counts them.
struct ContentCounts {
    std::uint64_t cameras = 0; ///< that stand in its scene
    std::uint64_t lights = 0;
    std::uint64_t masked_materials = 0; ///< whose alpha cuts holes; of those that objects have
    std::uint64_t masked_objects = 0;
    std::uint64_t blended_materials = 0; ///< that light shines through; likewise
    std::uint64_t blended_objects = 0;
    std::uint64_t clear_materials = 0; ///< of masked and blended ones, those with a base alpha of 0
    /// Whose vertices have an alpha below 1 where no material says what that does, as in PLY.
    std::uint64_t vertex_alpha_objects = 0;
    std::uint64_t skinned_objects = 0;
    std::uint64_t morphed_objects = 0;
    std::uint64_t animations = 0;
    std::uint64_t free_form_shapes = 0; ///< curves and surfaces of an OBJ file
};

struct FileContents {
    ContentCounts counts;
    std::vector<std::string> unread_extensions; ///< of glTF, that the file can do without
};

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
