#include "store/baseline/baseline_json.hpp"

#include "store/baseline/configuration_text.hpp"
#include "store/json_values.hpp"
#include "store/run/error_buckets_json.hpp"

#include <algorithm>
#include <map>

namespace gnomon::store {

namespace {

using Texts = std::map<std::string, std::string>;

/// The parameters that every entry has, with the same value.
Texts common_parameters(const std::vector<analysis::GateEntry>& entries)
{
    Texts common = entries.empty() ? Texts{} : entries.front().parameters;
    for (const analysis::GateEntry& entry : entries) {
        std::erase_if(common, [&](const auto& parameter) {
            const auto found = entry.parameters.find(parameter.first);
            return found == entry.parameters.end() || found->second != parameter.second;
        });
    }
    return common;
}

/// The texts by their keys, but for those that `without` has.
Json texts_json(const Texts& texts, const Texts& without)
{
    Json json = Json::object();
    for (const auto& [key, value] : texts) {
        if (!without.contains(key)) {
            json[key] = value;
        }
    }
    return json;
}

Json entry_json(const analysis::GateEntry& entry, const Texts& common)
{
    Json json = key_json(entry.key);
    json["parameters"] = texts_json(entry.parameters, common);
    Json metrics = Json::object();
    for (const auto& [name, value] : entry.metrics) {
        metrics[name] = metric_json(name, value);
    }
    json["metrics"] = std::move(metrics);
    if (!entry.cells.empty()) {
        json["parts"] = cells_json(entry.cells);
    }
    if (!entry.pixels.empty()) {
        json["wrong_pixels"] = entry.pixels;
    }
    return json;
}

} // namespace

std::string baseline_json(const analysis::GateEntries& run)
{
    const Texts common = common_parameters(run.entries);
    Json configurations = Json::array();
    for (const analysis::GateEntry& entry : run.entries) {
        configurations.push_back(entry_json(entry, common));
    }
    const analysis::Environment& environment = run.environment;
    const Json json{{"schema", baseline_schema},
                    {"environment",
                     {{"embree", environment.embree},
                      {"gl_renderer", environment.gl_renderer},
                      {"gl_version", environment.gl_version},
                      {"gnomon", environment.gnomon}}},
                    {"axes", run.axes},
                    {"parameters", texts_json(common, {})},
                    {"configurations", std::move(configurations)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::store
