#include "scene/job/file.hpp"

#include "scene/job/source.hpp"

namespace gnomon::scene {
namespace {

std::vector<Case> cases_of(const JobSource& source)
{
    std::vector<Case> cases;
    for (const CaseLayer& each : source.cases) {
        cases.push_back({each.name, {}});
        for (const Setting& setting : each.layer) {
            cases.back().overrides.push_back({setting.key().text(), to_toml(setting.value)});
        }
    }
    return cases;
}

const CaseLayer* chosen_case(const JobSource& source, std::string_view name)
{
    return name.empty() ? nullptr : &find_case(source, name);
}

} // namespace

JobFile job_of(const JobSource& source, std::string_view case_name)
{
    return {make_job(source, chosen_case(source, case_name)), source.sweep, cases_of(source)};
}

std::vector<LightJob> light_jobs(const JobSource& source, std::string_view case_name)
{
    const CaseLayer* chosen = chosen_case(source, case_name);
    if (source.lights.empty()) {
        return {{{}, make_job(source, chosen)}};
    }
    std::vector<LightJob> jobs;
    for (const std::string& light : source.lights) {
        jobs.push_back({light, make_job(source, chosen, {}, light)});
    }
    return jobs;
}

JobFile read_job(const std::filesystem::path& path, const std::vector<Override>& overrides,
                 std::string_view case_name, const Keys& keys)
{
    return job_of(read_job_source(path, overrides, {}, keys), case_name);
}

JobFile builtin_job(std::string_view name, const std::vector<Override>& overrides, const Keys& keys)
{
    return job_of(builtin_job_source(name, overrides, {}, keys));
}

namespace {

std::string_view stage_name(Stage stage)
{
    switch (stage) {
    case Stage::scene:
        return "scene";
    case Stage::truth:
        return "truth";
    case Stage::receivers:
        return "receivers";
    case Stage::shadow_map:
        return "shadow_map";
    case Stage::prefilter:
        return "prefilter";
    case Stage::lookup:
        return "lookup";
    case Stage::bias:
        return "bias";
    }
    return {};
}

} // namespace

std::vector<std::string_view> stage_names(Stages stages)
{
    std::vector<std::string_view> names;
    for (unsigned bit = 1; bit <= static_cast<unsigned>(Stage::bias); bit <<= 1U) {
        if ((stages & bit) != 0) {
            names.push_back(stage_name(static_cast<Stage>(bit)));
        }
    }
    return names;
}

} // namespace gnomon::scene
