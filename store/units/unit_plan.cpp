#include "store/units/unit_plan.hpp"

#include "scene/error.hpp"
#include "scene/fnv1a.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>

namespace gnomon::store {

namespace {

constexpr int plan_schema = 1;

/// A plan of 10⁷ configurations in single steps takes some 300 MB.
constexpr std::uint64_t most_plan_bytes = std::uint64_t{1} << 30U;

std::string digits_of(const scene::Fnv1a& hash)
{
    return fmt::format("{:016x}", hash.value());
}

Json json_of(const PlannedJob& job)
{
    return {{"path", job.path},       {"text", job.text},
            {"builtin", job.builtin}, {"preset", job.preset},
            {"case", job.case_name},  {"light", job.light ? Json(*job.light) : Json(nullptr)},
            {"set", job.settings},    {"axes", job.axes}};
}

Json json_of(const std::vector<PlannedScene>& scenes)
{
    Json all = Json::array();
    for (const PlannedScene& scene : scenes) {
        all.push_back({{"name", scene.name},
                       {"keys", scene.keys},
                       {"hash", scene.hash},
                       {"brought", scene.brought}});
    }
    return all;
}

Json runs_json(const std::vector<analysis::OrdinalRun>& runs)
{
    Json all = Json::array();
    for (const analysis::OrdinalRun& run : runs) {
        all.push_back({run.first, run.count, run.step});
    }
    return all;
}

double seconds_of(const UnitPlan& plan)
{
    return std::accumulate(plan.units.begin(), plan.units.end(), 0.0,
                           [](double sum, const PlannedUnit& unit) { return sum + unit.seconds; });
}

/// The part of the header that the plan's id covers.
Json common_json(const UnitPlan& plan)
{
    return {{"schema", plan_schema},
            {"gnomon", plan.gnomon},
            {"job", json_of(plan.job)},
            {"command", plan.command},
            {"compare_command", plan.compare_command},
            {"configurations", plan.size},
            {"units", plan.units.size()},
            {"estimated_seconds", seconds_of(plan)},
            {"keeps_normals", plan.keeps_normals},
            {"scenes", json_of(plan.scenes)}};
}

std::string unit_line(const PlannedUnit& unit)
{
    const Json line{{"unit", unit.id},
                    {"number", unit.number},
                    {"estimated_seconds", unit.seconds},
                    {"configurations", unit.configurations},
                    {"scenes", unit.scenes},
                    {"ordinals", runs_json(unit.ordinals)}};
    return json_text(line, -1) + "\n";
}

/// @param common  `common_json` as text.
std::string unit_id(const std::string& common, const PlannedUnit& unit)
{
    scene::Fnv1a hash;
    hash.add(common);
    for (const analysis::OrdinalRun& run : unit.ordinals) {
        for (const std::uint64_t number : {run.first, run.count, run.step}) {
            hash.add(&number, sizeof number);
        }
    }
    return digits_of(hash);
}

std::string plan_id(const std::string& common, const UnitPlan& plan)
{
    scene::Fnv1a hash;
    hash.add(common);
    for (const PlannedUnit& unit : plan.units) {
        hash.add(unit_line(unit));
    }
    return digits_of(hash);
}

[[noreturn]] void refuse_plan(const std::filesystem::path& path, std::string_view what)
{
    throw scene::InputError(scene::one_line(
        fmt::format("{}: {}; make one with `gnomon plan JOB --out FILE`", path.string(), what)));
}

PlannedJob read_planned_job(const Json& json)
{
    PlannedJob job;
    job.path = json.at("path").get<std::string>();
    job.text = json.at("text").get<std::string>();
    job.builtin = json.at("builtin").get<std::string>();
    job.preset = json.at("preset").get<std::string>();
    job.case_name = json.at("case").get<std::string>();
    if (!json.at("light").is_null()) {
        job.light = json.at("light").get<std::string>();
    }
    job.settings = json.at("set").get<std::vector<std::string>>();
    job.axes = json.at("axes").get<std::vector<std::string>>();
    return job;
}

UnitPlan read_common(const Json& json)
{
    UnitPlan plan;
    plan.id = json.at("plan").get<std::string>();
    plan.gnomon = json.at("gnomon").get<std::string>();
    plan.directory = json.at("directory").get<std::string>();
    plan.job = read_planned_job(json.at("job"));
    plan.command = json.at("command").get<std::string>();
    plan.compare_command = json.at("compare_command").get<std::string>();
    plan.size = json.at("configurations").get<std::uint64_t>();
    plan.keeps_normals = json.at("keeps_normals").get<bool>();
    for (const Json& scene : json.at("scenes")) {
        plan.scenes.push_back(
            {scene.at("name").get<std::string>(), scene.at("keys").get<std::string>(),
             scene.at("hash").get<std::string>(), scene.at("brought").get<std::string>()});
    }
    return plan;
}

/// @param size  of the sweep; a run beyond it is refused before memory is allocated.
analysis::OrdinalRun read_run(const Json& json, std::uint64_t size,
                              const std::filesystem::path& path)
{
    const analysis::OrdinalRun run{json.at(0).get<std::uint64_t>(), json.at(1).get<std::uint64_t>(),
                                   json.at(2).get<std::uint64_t>()};
    const bool fits = run.first < size && run.count >= 1 && run.step >= 1 && run.step <= size &&
                      run.count - 1 <= (size - 1 - run.first) / run.step;
    if (!fits) {
        refuse_plan(path, "a unit has ordinals beyond the end of the sweep");
    }
    return run;
}

PlannedUnit read_unit(const Json& json, std::uint64_t size, const std::filesystem::path& path)
{
    PlannedUnit unit;
    unit.id = json.at("unit").get<std::string>();
    unit.number = json.at("number").get<std::uint32_t>();
    unit.seconds = json.at("estimated_seconds").get<double>();
    unit.configurations = json.at("configurations").get<std::uint64_t>();
    unit.scenes = json.at("scenes").get<std::vector<std::string>>();
    for (const Json& run : json.at("ordinals")) {
        unit.ordinals.push_back(read_run(run, size, path));
    }
    return unit;
}

/// Removes the first line from the text and returns it.
std::string_view next_line(std::string_view& text)
{
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

UnitPlan parse_plan(std::string_view text, const std::filesystem::path& path)
{
    const Json header = Json::parse(next_line(text), nullptr, false);
    if (!header.is_object() || !header.contains("plan") || !header.contains("schema")) {
        refuse_plan(path, "is not the plan of a sweep");
    }
    if (header.at("schema") != plan_schema) {
        refuse_plan(path, fmt::format("its schema is {}, this Gnomon's is {}",
                                      header.at("schema").dump(), plan_schema));
    }
    UnitPlan plan = read_common(header);
    const auto units = header.at("units").get<std::size_t>();
    while (!text.empty()) {
        plan.units.push_back(read_unit(Json::parse(next_line(text)), plan.size, path));
    }
    if (plan.units.size() != units) {
        refuse_plan(path, fmt::format("is incomplete: it has {} of its {} units", plan.units.size(),
                                      units));
    }
    return plan;
}

} // namespace

void complete_plan(UnitPlan& plan)
{
    const std::string common = json_text(common_json(plan), -1);
    std::uint32_t number = 0;
    for (PlannedUnit& unit : plan.units) {
        unit.number = ++number;
        unit.id = unit_id(common, unit);
    }
    plan.id = plan_id(common, plan);
}

std::string plan_text(const UnitPlan& plan)
{
    Json header{{"plan", plan.id}, {"directory", plan.directory.string()}};
    header.update(common_json(plan));
    std::string text = json_text(header, -1) + "\n";
    for (const PlannedUnit& unit : plan.units) {
        text += unit_line(unit);
    }
    return text;
}

UnitPlan read_unit_plan(const std::filesystem::path& path)
{
    const std::string text =
        scene::read_text_file(path, scene::one_line(path.string()), "plan", most_plan_bytes);
    UnitPlan plan;
    try {
        plan = parse_plan(text, path);
    } catch (const Json::exception&) {
        refuse_plan(path, "is not the plan of a sweep, or is incomplete");
    }
    if (plan_id(json_text(common_json(plan), -1), plan) != plan.id) {
        refuse_plan(path, "was edited after it was made");
    }
    return plan;
}

const PlannedUnit& find_unit(const UnitPlan& plan, std::string_view name,
                             const std::filesystem::path& path)
{
    constexpr std::size_t id_digits = 16;
    if (name.size() == id_digits) {
        const auto found = std::ranges::find(plan.units, name, &PlannedUnit::id);
        if (found != plan.units.end()) {
            return *found;
        }
    }
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size() && number >= 1 &&
        number <= plan.units.size()) {
        return plan.units[number - 1];
    }
    throw scene::InputError(scene::one_line(
        fmt::format("{}: no unit {}: name one by its id, or by its number from 1 to {}",
                    path.string(), name, plan.units.size())));
}

} // namespace gnomon::store
