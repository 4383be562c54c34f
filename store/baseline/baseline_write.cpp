#include "store/baseline/baseline.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/baseline/kept_wrong_pixels.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"
#include "store/run/error_buckets_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace gnomon::store {

namespace {

using Texts = std::map<std::string, std::string>;

/// The parameters that have the same value in every entry.
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

/// The texts by key, except keys in `without`.
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
        json["parts"] = error_buckets_json(entry.cells);
    }
    if (!entry.pixels.empty()) {
        json["wrong_pixels"] = entry.pixels;
    }
    return json;
}

/// The run's results with masks named by `name_mask`. Names none unless the pixels of all
/// configurations were kept: a sweep may keep those of its best and worst, which change from run to
/// run.
template <typename NameMask>
analysis::GateEntries with_names(const GateRun& run, const NameMask& name_mask)
{
    analysis::GateEntries results = run.results;
    const bool keeps_all = std::ranges::none_of(
        results.entries, [](const analysis::GateEntry& entry) { return entry.pixels.empty(); });
    for (analysis::GateEntry& entry : results.entries) {
        entry.pixels =
            keeps_all ? name_mask(read_wrong_pixels(run.folder, entry.pixels).mask) : std::string{};
    }
    return results;
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
    return json_text(json, 2) + "\n";
}

analysis::GateEntries with_mask_names(const GateRun& run)
{
    return with_names(run, mask_name);
}

analysis::GateEntries write_masks(const std::filesystem::path& baseline, const GateRun& run)
{
    return with_names(run,
                      [&](const analysis::PixelMask& mask) { return write_mask(baseline, mask); });
}

void write_baseline(const std::filesystem::path& file, const analysis::GateEntries& entries)
{
    const std::string text = baseline_json(entries);
    if (text.size() > most_baseline_bytes) {
        throw scene::InputError(fmt::format(
            "{}: {} configurations are too many for a baseline of at most {} MiB: sweep fewer",
            scene::one_line(file.string()), entries.entries.size(), most_baseline_bytes >> 20U));
    }
    write_file(file, text);
    remove_other_masks(file, entries);
}

} // namespace gnomon::store
