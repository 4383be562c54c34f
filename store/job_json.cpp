#include "store/job_json.hpp"

#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/json_values.hpp"

#include <algorithm>

namespace gnomon::store {

Json job_object(const analysis::Comparison& comparison)
{
    const auto& evaluation = comparison.evaluation;
    Json json = Json::object();
    for (const auto& [key, value] : scene::resolved_keys(comparison.job)) {
        if (evaluation &&
            std::ranges::find(evaluation->given_keys, key) == evaluation->given_keys.end()) {
            continue;
        }
        Json parsed = Json::parse(value, nullptr, false);
        json[key] = parsed.is_discarded() ? Json(value) : parsed;
    }
    return json;
}

std::string job_json(const analysis::Comparison& comparison)
{
    return json_text(job_object(comparison), -1);
}

} // namespace gnomon::store
