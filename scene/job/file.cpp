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
            cases.back().overrides.push_back({setting.spec->key.name, to_toml(setting.value)});
        }
    }
    return cases;
}

} // namespace

JobFile read_job(const std::filesystem::path& path, const std::vector<Override>& overrides,
                 std::string_view case_name)
{
    const JobSource source = read_job_source(path, overrides);
    const CaseLayer* chosen = case_name.empty() ? nullptr : &find_case(source, case_name);
    return {make_job(source, chosen), source.sweep, cases_of(source)};
}

JobFile builtin_job(std::string_view name, const std::vector<Override>& overrides)
{
    return {make_job(builtin_job_source(name, overrides)), {}, {}};
}

} // namespace gnomon::scene
