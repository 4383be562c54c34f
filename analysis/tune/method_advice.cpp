#include "analysis/tune/method_tune.hpp"

#include "analysis/advice/advise.hpp"
#include "analysis/bias/bias_units.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <utility>

namespace gnomon::analysis {

using scene::Job;

namespace {

/// The keys and tables to remove from the job's file for the method to accept it.
std::vector<std::string> keys_to_remove(const Job& job, const std::string& method)
{
    const scene::KeyTable& keys = scene::keys_of(job);
    std::vector<std::string> removed;
    for (const std::string_view table : {"shadow_map", "lookup", "bias"}) {
        if (!keys.has_key(method, fmt::format("{}.", table))) {
            removed.push_back(fmt::format("[{}]", table));
        }
    }
    const bool reads_lookup = keys.has_key(method, "lookup.outside");
    if (reads_lookup && scene::has_filters(job) && !keys.has_filters(method)) {
        removed.emplace_back("lookup.filter");
    }
    for (const auto& [key, value] : job.method.values) {
        const bool is_of_lost_table = key.starts_with("bias.") && !keys.has_key(method, "bias.");
        const scene::Key* row = keys.find(key);
        if ((row == nullptr || !row->is_of(method)) && !is_of_lost_table) {
            removed.push_back(key);
        }
    }
    return removed;
}

/// The changed keys; at least the method changes.
std::vector<std::string> remedy_keys_of(const Job& job, const Job& tuned)
{
    std::vector<std::string> keys = changed_keys(job, tuned);
    const std::vector<std::string> removed = keys_to_remove(job, tuned.method.name);
    if (!removed.empty()) {
        keys.front() += fmt::format(" # and remove {}", fmt::join(removed, ", "));
    }
    return keys;
}

} // namespace

void advise_methods(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
                    const Renderers& renderers, const MethodRequest& request,
                    const MethodProgress& progress)
{
    const Job& job = comparison.job;
    TuneResult found = tune_methods(job, file, renderers, views, no_limits(), request, progress);
    if (!found.nothing.empty()) {
        return;
    }
    for (const TunedMethod& method : found.methods->ranked) {
        const Job tuned = tuned_job(job, method.best);
        const scene::View view = scene::resolve_view(with_view_of(tuned, views.own().view.job),
                                                     file.scene, file.defaults);
        std::optional<BiasLength> bias;
        if (scene::has_key(tuned, "bias.constant")) {
            const BiasLengths lengths{view.first_map(), tuned.shadow_map.resolution_texels,
                                      views.own().median_light_distance_m};
            bias = lengths.of(method.best.bias.constant());
        }
        std::vector<std::string> keys = remedy_keys_of(job, tuned);
        if (keys.empty()) {
            continue; // the unchanged job
        }
        const ViewOutcome& own = method.measured.front();
        comparison.advice.push_back({std::move(keys), outcome_of(own), own.metrics.error_rate,
                                     method.best.cost, MeasuredBy::rerun, bias, method.measured});
    }
    comparison.methods_passed_over = std::move(found.methods->passed_over);
}

} // namespace gnomon::analysis
