#include "reports/json/scene_notes_json.hpp"

#include "store/json_values.hpp"

namespace gnomon::reports {

store::Json scene_notes_json(std::span<const scene::SceneNote> notes)
{
    store::Json json = store::Json::array();
    for (const scene::SceneNote& note : notes) {
        json.push_back({{"kind", note.kind}, {"count", note.count}, {"text", note.text}});
    }
    return json;
}

} // namespace gnomon::reports
