#include "api/advice.hpp"

#include "analysis/advice/advise.hpp"
#include "analysis/advice/cures.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/sweep/compare.hpp"
#include "analysis/tune/method_tune.hpp"
#include "methods/job_method.hpp"
#include "methods/list.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/text.hpp"
#include "scene/view/moved_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace gnomon::api {
namespace {

using analysis::Comparison;

bool is_of_view(const std::string& key)
{
    return key.starts_with("camera.") || key.starts_with("light.") || key.starts_with("image.") ||
           key == "scene.north";
}

/// The keys that must not differ between views.
std::map<std::string, std::string> shared_keys(const scene::Job& job)
{
    std::map<std::string, std::string> keys;
    for (auto& [key, value] : scene::resolved_keys(job)) {
        if (!is_of_view(key)) {
            keys.emplace(key, value);
        }
    }
    return keys;
}

void require_same_keys(const scene::Job& job, const scene::Job& of_case, const std::string& name)
{
    const auto own = shared_keys(job);
    const auto other = shared_keys(of_case);
    for (const auto* const keys : {&own, &other}) {
        for (const auto& [key, value] : *keys) {
            const auto a = own.find(key);
            const auto b = other.find(key);
            if (a == own.end() || b == other.end() || a->second != b->second) {
                throw scene::InputError(
                    fmt::format("all cases: case {} changes {}: views may differ in camera, light "
                                "and image alone; give that case by itself",
                                name, key));
            }
        }
    }
}

/// If float32 matrices and positions cost more precision than the depth format, compares the scene
/// with its origin moved nearer, and adds the result to the advice.
void advise_origin(Comparison& comparison, const ComparisonSession& session)
{
    const auto& kinds = comparison.precision_kinds;
    if (!kinds || kinds->transform <= kinds->format) {
        return;
    }
    const auto moved = scene::move_origin_near(comparison.job, session.file());
    if (!moved) {
        return;
    }
    const LoadedScene there_scene{session.context(), moved->file.scene, session.options()};
    const Comparison there = analysis::compare(moved->job, moved->file, there_scene.renderers());
    const scene::Vec3f origin{moved->origin}; // exact in float32, with fewer digits to read
    comparison.advice.push_back(
        {{fmt::format("{}the scene's origin to [{}, {}, {}]", analysis::origin_comment, origin.x,
                      origin.y, origin.z)},
         {{there.metrics.false_shadow, there.metrics.false_lit},
          there.metrics.amounts,
          there.diagnosis ? there.diagnosis->causes.amounts.softening() : 0,
          there.diagnosis ? there.diagnosis->left_out().total() : 0},
         there.metrics.error_rate,
         analysis::lookup_cost(comparison.job),
         analysis::MeasuredBy::rerun});
    if (there.diagnosis) {
        comparison.advice.back().left = analysis::named_errors(there);
    }
}

std::vector<std::string> method_names()
{
    std::vector<std::string> names;
    for (const methods::Method& method : methods::methods()) {
        names.emplace_back(method.name);
    }
    return names;
}

void require_method(const std::string& name, const std::vector<std::string>& known)
{
    if (std::ranges::find(known, name) == known.end()) {
        const std::string nearest = scene::similar_word(name, known);
        throw scene::InputError(fmt::format(
            "methods {}: unknown method{}; use all, or some of {}", name,
            nearest.empty() ? std::string{} : fmt::format(" (did you mean {}?)", nearest),
            fmt::join(known, ",")));
    }
}

} // namespace

analysis::ViewRequest view_request(const ViewOptions& options, const scene::JobSource& source,
                                   std::string_view light)
{
    analysis::ViewRequest request{options.cameras, options.lights, {}};
    if (!options.all_cases) {
        return request;
    }
    if (source.cases.empty()) {
        throw scene::InputError("all cases: the job defines no [[case]]; omit the option");
    }
    const scene::JobSource of_light = light.empty() ? source : scene::only_light(source, light);
    const scene::Job own = scene::job_of(of_light).job;
    for (const scene::CaseLayer& one : source.cases) {
        request.cases.push_back({one.name, scene::job_of(of_light, one.name).job});
        require_same_keys(own, request.cases.back().job, one.name);
    }
    return request;
}

analysis::MethodRequest method_request(std::span<const std::string> names,
                                       std::optional<std::uint64_t> max_bytes)
{
    const std::vector<std::string> known = method_names();
    if (names.size() == 1 && names.front() == "all") {
        return {known, max_bytes};
    }
    analysis::MethodRequest request{{}, max_bytes};
    for (const std::string& name : names) {
        require_method(name, known);
        if (std::ranges::find(request.methods, name) == request.methods.end()) {
            request.methods.push_back(name);
        }
    }
    return request;
}

void require_advisable(std::span<const scene::LightJob> jobs)
{
    for (const scene::LightJob& light : jobs) {
        if (!methods::traits(light.job).has_map) {
            throw scene::InputError(
                fmt::format("advice: method.name = \"{}\" has no map and no bias "
                            "to change; ask for other methods with it",
                            light.job.method.name));
        }
    }
}

void advise(Comparison& comparison, const ComparisonSession& session,
            const analysis::ViewRequest& views,
            const std::optional<analysis::MethodRequest>& methods,
            const analysis::MethodProgress& progress)
{
    if (comparison.metrics.pixels.scored() == 0) {
        return;
    }
    const auto judged =
        analysis::judge_views(comparison.job, session.file(), session.renderers(), views);
    analysis::advise(comparison, judged, session.file(), session.renderers());
    if (methods) {
        analysis::advise_methods(comparison, judged, session.file(), session.renderers(), *methods,
                                 progress);
    }
    advise_origin(comparison, session);
    analysis::explain_advice(comparison, session.file(), session.renderers());
}

} // namespace gnomon::api
