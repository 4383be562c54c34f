#include "store/baseline/baseline.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "methods/key_table.hpp"
#include "scene/job/keys/written_key.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/text.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/json_values.hpp"
#include "store/run/error_buckets_json.hpp"
#include "store/run/run_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <system_error>
#include <vector>

namespace gnomon::store {

namespace {

using BaselineTexts = std::map<std::string, std::string>;

constexpr const char* baseline_advice = "save it again with `gnomon baseline save`";
/// The counts of error buckets are 7 deep.
constexpr int deepest_json = 8;
/// A double holds every integer up to here exactly.
constexpr double largest_exact_count = 9007199254740992.0;

/// Whether an axis is the light, or a key of one light.
bool is_of_lights(const std::string& key)
{
    return key == scene::light_distinction ||
           !scene::find_written_key(*methods::key_table(), key).light.empty();
}

/// Whether a key may be a parameter.
bool is_parameter(const std::string& key)
{
    static const std::set<std::string, std::less<>> names = [] {
        std::set<std::string, std::less<>> all{"scene_hash"};
        for (const JobColumn& column : job_columns()) {
            all.insert(column.name);
        }
        return all;
    }();
    return names.contains(key) || scene::is_engine_key(key);
}

/// Reads one baseline; messages name the file and the place.
class BaselineParser {
public:
    explicit BaselineParser(std::string name) : name_{std::move(name)} {}

    [[nodiscard]] analysis::GateEntries read(const std::string& text) const
    {
        const Json json = parsed(text);
        require_members(json, "the file",
                        {"schema", "environment", "axes", "parameters", "configurations"});
        if (json["schema"] != baseline_schema) {
            fail("schema", fmt::format("is not {}: save the baseline again with this version",
                                       baseline_schema));
        }
        analysis::GateEntries baseline;
        baseline.environment = read_environment(json["environment"]);
        baseline.axes = read_axes(json["axes"]);
        const BaselineTexts common = read_texts(json["parameters"], "parameters");
        const Json& configurations = json["configurations"];
        if (!configurations.is_array() || configurations.empty()) {
            fail("configurations", "must be a list of configurations, with at least one");
        }
        for (std::size_t i = 0; i < configurations.size(); ++i) {
            baseline.entries.push_back(read_entry(
                configurations[i], fmt::format("configurations[{}]", i), common, baseline.axes));
        }
        if (const auto twins = sort_entries(baseline)) {
            fail("configurations",
                 fmt::format("two of them are {}", key_text(baseline.entries[twins->first].key)));
        }
        return baseline;
    }

private:
    [[noreturn]] void fail(std::string_view place, std::string_view problem) const
    {
        throw scene::InputError(fmt::format("{}: {}: {}; {}", name_,
                                            scene::one_line(place.substr(0, 200)), problem,
                                            baseline_advice));
    }

    /// Parses the text and refuses repeated keys, of which the parser would keep the last.
    [[nodiscard]] Json parsed(const std::string& text) const
    {
        std::vector<std::set<std::string>> keys;
        const auto watch = [&](int depth, Json::parse_event_t event, const Json& value) {
            if (depth > deepest_json) {
                fail("the file", "nests too deeply to be a baseline");
            }
            if (event == Json::parse_event_t::object_start) {
                keys.emplace_back();
            } else if (event == Json::parse_event_t::object_end) {
                keys.pop_back();
            } else if (event == Json::parse_event_t::key &&
                       !keys.back().insert(value.get<std::string>()).second) {
                fail(value.get<std::string>(), "the key occurs twice in one object");
            }
            return true;
        };
        try {
            return Json::parse(text, watch);
        } catch (const Json::exception& error) {
            throw scene::InputError(fmt::format("{}: not JSON, or cut short: {}", name_,
                                                scene::one_line(error.what()).substr(0, 300)));
        }
    }

    void require_members(const Json& json, const std::string& place,
                         const std::set<std::string>& wanted,
                         const std::set<std::string>& optional = {}) const
    {
        if (!json.is_object()) {
            fail(place, "must be an object");
        }
        for (const std::string& key : wanted) {
            if (!json.contains(key)) {
                fail(place, fmt::format("lacks \"{}\"", key));
            }
        }
        for (const auto& [key, value] : json.items()) {
            if (!wanted.contains(key) && !optional.contains(key)) {
                fail(fmt::format("{}.{}", place, key), "the key is unknown");
            }
        }
    }

    [[nodiscard]] std::string read_text(const Json& json, const std::string& place) const
    {
        if (!json.is_string()) {
            fail(place, "must be a string");
        }
        return json.get<std::string>();
    }

    [[nodiscard]] analysis::Environment read_environment(const Json& json) const
    {
        require_members(json, "environment", {"embree", "gl_renderer", "gl_version", "gnomon"});
        return {read_text(json["gl_renderer"], "environment.gl_renderer"),
                read_text(json["gl_version"], "environment.gl_version"),
                read_text(json["embree"], "environment.embree"),
                read_text(json["gnomon"], "environment.gnomon")};
    }

    [[nodiscard]] std::vector<std::string> read_axes(const Json& json) const
    {
        if (!json.is_array()) {
            fail("axes", "must be a list");
        }
        std::vector<std::string> axes;
        for (const Json& axis : json) {
            axes.push_back(read_text(axis, "axes"));
            if ((!is_parameter(axes.back()) && !is_of_lights(axes.back())) ||
                std::count(axes.begin(), axes.end(), axes.back()) > 1) {
                fail("axes", "names an unknown key, or one key twice");
            }
        }
        return axes;
    }

    using IsKnown = bool (*)(const std::string&);

    [[nodiscard]] BaselineTexts read_texts(const Json& json, const std::string& place,
                                           IsKnown is_known = is_parameter) const
    {
        if (!json.is_object()) {
            fail(place, "must be an object");
        }
        BaselineTexts texts;
        for (const auto& [key, value] : json.items()) {
            const std::string there = fmt::format("{}.{}", place, key);
            if (!is_known(key)) {
                fail(there, "is not a job key");
            }
            texts.emplace(key, read_text(value, there));
        }
        return texts;
    }

    [[nodiscard]] analysis::GateEntry read_entry(const Json& json, const std::string& place,
                                                 const BaselineTexts& common,
                                                 const std::vector<std::string>& axes) const
    {
        require_members(json, place, {"case", "axes", "parameters", "metrics"},
                        {"parts", "wrong_pixels"});
        analysis::GateEntry entry;
        entry.key.case_name = read_text(json["case"], place + ".case");
        entry.key.axes = read_texts(json["axes"], place + ".axes", [](const std::string& axis) {
            return is_parameter(axis) || is_of_lights(axis);
        });
        const bool has_all = std::all_of(axes.begin(), axes.end(), [&](const std::string& axis) {
            return entry.key.axes.contains(axis);
        });
        if (!has_all || entry.key.axes.size() != axes.size()) {
            fail(place + ".axes", "are not those of \"axes\"");
        }
        entry.parameters = read_texts(json["parameters"], place + ".parameters");
        for (const auto& [key, value] : common) {
            if (!entry.parameters.emplace(key, value).second) {
                fail(fmt::format("{}.parameters.{}", place, key), "also occurs in \"parameters\"");
            }
        }
        for (const std::string& axis : axes) {
            if (entry.parameters.contains(axis)) {
                fail(fmt::format("{}.parameters.{}", place, axis), "is an axis");
            }
        }
        entry.metrics = read_metrics(json["metrics"], place + ".metrics");
        read_places(entry, json, place);
        if (const std::string contradiction = find_contradiction(entry); !contradiction.empty()) {
            fail(place, contradiction);
        }
        return entry;
    }

    void read_places(analysis::GateEntry& entry, const Json& json, const std::string& place) const
    {
        if (json.contains("parts")) {
            try {
                entry.cells = error_buckets_from_json(json["parts"], place + ".parts");
            } catch (const scene::InputError& error) {
                throw scene::InputError(
                    fmt::format("{}: {}; {}", name_, error.what(), baseline_advice));
            }
        }
        if (json.contains("wrong_pixels")) {
            entry.pixels = read_text(json["wrong_pixels"], place + ".wrong_pixels");
            if (!is_mask_name(entry.pixels)) {
                fail(place + ".wrong_pixels", "is not the name of a mask");
            }
        }
    }

    [[nodiscard]] std::map<std::string, double> read_metrics(const Json& json,
                                                             const std::string& place) const
    {
        if (!json.is_object() || json.empty()) {
            fail(place, "must be an object with metrics");
        }
        std::map<std::string, double> metrics;
        for (const auto& [key, value] : json.items()) {
            const std::string there = fmt::format("{}.{}", place, key);
            const analysis::GateMetric* const metric = analysis::find_gate_metric(key);
            if (metric == nullptr) {
                fail(there, "is not a metric");
            }
            metrics.emplace(key, read_number(value, *metric, there));
        }
        return metrics;
    }

    [[nodiscard]] double read_number(const Json& json, const analysis::GateMetric& metric,
                                     const std::string& place) const
    {
        const bool is_integer = metric.is_whole;
        if (!json.is_number() || (is_integer && !json.is_number_unsigned())) {
            fail(place, is_integer ? "must be a count" : "must be a number");
        }
        const auto number = json.get<double>();
        if (!std::isfinite(number) || (is_integer && number > largest_exact_count)) {
            fail(place, "is too large");
        }
        return number;
    }

    std::string name_;
};

} // namespace

analysis::GateEntries read_baseline(const std::filesystem::path& file)
{
    const std::string name = scene::one_line(file.string());
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown)) {
        throw BaselineMissing(fmt::format(
            "{}: there is no baseline: make one with `gnomon baseline save RUN --baseline FILE`",
            name));
    }
    return parse_baseline(scene::read_text_file(file, scene::one_line(file.string()), "baseline",
                                                most_baseline_bytes),
                          name);
}

analysis::GateEntries parse_baseline(const std::string& text, const std::string& name)
{
    return BaselineParser{name}.read(text);
}

} // namespace gnomon::store
