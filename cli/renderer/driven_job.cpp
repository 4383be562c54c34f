#include "cli/renderer/driven_job.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace gnomon::cli {

RendererSettings renderer_settings(RendererCommand command, const RendererOptions& options,
                                   int threads)
{
    return {std::move(command), temporary_folder(), options.longest(), threads};
}

scene::JobSource read_driven_job(const RendererSession& session, const JobOptions& options)
{
    JobOptions of_engine = options;
    of_engine.keys = options.keys->with_engine_keys(engine_keys(session.hello()));
    scene::JobSource source = read_any_job_source(of_engine);
    if (!source.lights.empty()) {
        throw scene::InputError(
            fmt::format("{}: another renderer draws one light at a time: choose one with --light, "
                        "{}",
                        source.name, fmt::join(source.lights, " or ")));
    }
    return source;
}

scene::SweepSpace space_of_one(scene::JobSource source, const std::string& case_name)
{
    source.sweep = {};
    if (case_name.empty()) {
        source.cases.clear();
    }
    return scene::SweepSpace{std::move(source), {}, case_name};
}

void refuse_for_renderer(std::initializer_list<std::pair<std::string_view, bool>> options)
{
    for (const auto& [name, is_given] : options) {
        if (is_given) {
            throw scene::InputError(
                fmt::format("{}: is about GL's own shadows; leave it away, or the renderer", name));
        }
    }
}

std::vector<std::string> key_names(const std::vector<std::pair<std::string, std::string>>& keys)
{
    std::vector<std::string> names;
    for (const auto& [key, value] : keys) {
        names.push_back(key);
    }
    return names;
}

} // namespace gnomon::cli
