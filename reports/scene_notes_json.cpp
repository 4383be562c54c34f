#include "reports/scene_notes_json.hpp"

namespace gnomon::reports {

Json scene_notes_json(std::span<const scene::SceneNote> notes)
{
    Json json = Json::array();
    for (const scene::SceneNote& note : notes) {
        json.push_back({{"kind", note.kind}, {"count", note.count}, {"text", note.text}});
    }
    return json;
}

} // namespace gnomon::reports
