#pragma once

#include "scene/geometry/triangles.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

struct Job;
struct SceneDefaults;
struct TriangleScene;

/// A remark about a scene that affects how to read its numbers.
struct SceneNote {
    std::string kind; ///< a stable identifier of docs/json_schema.md#scene-notes
    std::uint64_t count = 0;
    std::string text; ///< a sentence without capital and full stop

    friend bool operator==(const SceneNote&, const SceneNote&) = default;
};

/// Whether camera and light come from the scene's file.
struct LeftToFile {
    bool camera = false;
    bool light = false;

    friend auto operator<=>(const LeftToFile&, const LeftToFile&) = default;
};
[[nodiscard]] LeftToFile left_to_file(const Job& job);

/// Remarks about a scene: what its file supplied, and what Gnomon ignored or simplified. Empty if
/// the scene is compared unchanged.
[[nodiscard]] std::vector<SceneNote> scene_notes(const TriangleScene& scene,
                                                 const SceneDefaults& defaults, LeftToFile left);

/// The remark about an object that encloses the light.
[[nodiscard]] SceneNote enclosed_light_note(const std::string& object);

} // namespace gnomon::scene
