#include "analysis/tune/method_tune.hpp"

#include "analysis/sweep/compare.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

using scene::Job;

namespace {

/// Number of passes along every axis.
constexpr std::size_t search_rounds = 2;

std::string keys_text(const Job& job)
{
    std::string text;
    for (const auto& [key, value] : scene::resolved_keys(job)) {
        text += fmt::format("{} = {}\n", key, value);
    }
    return text;
}

/// Bytes that no map may exceed.
std::uint64_t bytes_allowed(const Job& job, const scene::SceneFile& file,
                            const MethodRequest& request)
{
    if (request.max_bytes) {
        return *request.max_bytes;
    }
    const methods::LookupTraits own = methods::traits(scene::with_layout(job, file.defaults));
    if (!own.has_map) {
        throw scene::InputError(
            fmt::format("method.name = \"{}\" has no map to bound the bytes of other methods; "
                        "set a limit on their bytes",
                        job.method.name));
    }
    return own.map_bytes;
}

/// Tries the settings of one method.
class MethodSearch {
public:
    /// Everything that a trial of settings needs.
    struct World {
        const Job& job;
        const scene::SceneFile& file;
        const Renderers& renderers;
        const CheckedViews& views;
        const TuneLimits& limits;
    };

    /// @param considered  Gets every setting that is tried.
    MethodSearch(const World& world, std::vector<TunedSetting>& considered,
                 const std::function<void(const TunedSetting&)>& progress)
        : world_{world},
          considered_{considered},
          progress_{progress}
    {
    }

    /// @return  The least wrong setting; empty with a reason if none can be tried.
    std::optional<TunedMethod> run(const MethodSpace& space, const std::string& name,
                                   std::string& reason)
    {
        found_.name = name;
        if (!begin(space, reason)) {
            return std::nullopt;
        }
        for (std::size_t round = 0; round < search_rounds; ++round) {
            const std::size_t before = *best_;
            for (std::size_t axis = 0; axis < space.axis_count(); ++axis) {
                go_along(space, axis);
            }
            if (*best_ == before) {
                break;
            }
        }
        try {
            finish();
        } catch (const scene::InputError& refused) {
            reason = refused.what(); // another view refuses it
            return std::nullopt;
        }
        return std::move(found_);
    }

private:
    /// Begins at the first start that can be tried; if none can, gives the reason of the first.
    bool begin(const MethodSpace& space, std::string& reason)
    {
        for (const TunedSetting& start : space.starts()) {
            std::string why;
            if (const auto index = consider(start, why)) {
                best_ = *index;
                return true;
            }
            reason = reason.empty() ? why : reason;
        }
        return false;
    }

    void go_along(const MethodSpace& space, std::size_t axis)
    {
        TunedSetting from = considered_[*best_];
        from.bias = {};
        for (const TunedSetting& other : space.along(axis, from)) {
            std::string why;
            const auto index = consider(other, why);
            if (!index) {
                note_refusal(from, other, why);
            } else if (is_less_wrong(considered_[*index], considered_[*best_])) {
                best_ = *index;
            }
        }
    }

    /// Notes each refusal once: the second pass meets those of the first.
    void note_refusal(const TunedSetting& from, const TunedSetting& other, const std::string& why)
    {
        const auto keys = changed_keys(tuned_job(world_.job, from), tuned_job(world_.job, other));
        const bool is_known = std::ranges::any_of(found_.refused, [&](const RefusedSetting& known) {
            return known.keys == keys && known.reason == why;
        });
        if (!is_known) {
            found_.refused.push_back({keys, why});
        }
    }

    /// Why the setting's job cannot be compared; empty if it can.
    [[nodiscard]] std::string refusal(const TunedSetting& setting) const
    {
        const Job tuned = tuned_job(world_.job, setting);
        if (setting.map.resolution_texels == 0) {
            return "even its smallest map exceeds the limit on bytes; raise the limit";
        }
        try {
            methods::check(tuned);
            (void)scene::resolve_view(with_view_of(tuned, world_.views.own().view.job),
                                      world_.file.scene, world_.file.defaults);
        } catch (const scene::InputError& refused) {
            return refused.what();
        }
        return {};
    }

    /// The setting's index, whether tried now or earlier; empty with a reason if it cannot be
    /// tried.
    std::optional<std::size_t> consider(const TunedSetting& setting, std::string& why)
    {
        const std::string keys = keys_text(tuned_job(world_.job, setting));
        if (const auto known = known_.find(keys); known != known_.end()) {
            return known->second;
        }
        why = refusal(setting);
        if (!why.empty()) {
            return std::nullopt;
        }
        TunedSetting tried = setting;
        try {
            tried.bias = find_bias(setting);
        } catch (const scene::InputError& refused) {
            why = refused.what(); // the driver lacks a feature
            return std::nullopt;
        }
        const std::size_t index = considered_.size();
        known_.emplace(keys, index);
        considered_.push_back(tried);
        ++found_.settings;
        if (progress_) {
            progress_(tried);
        }
        return index;
    }

    [[nodiscard]] FoundBias find_bias(const TunedSetting& setting) const
    {
        BiasSearch search{world_.file, world_.renderers, world_.views.turns_light};
        const auto slope = static_cast<float>(setting.slope);
        add_views(search, world_.job, setting, world_.views, 1);
        FoundBias found = search.find(world_.limits, slope, BiasSteps::coarse);
        if (found.meets_limits && world_.views.views.size() > 1) {
            add_views(search, world_.job, setting, world_.views, world_.views.views.size());
            found = search.find(world_.limits, slope, BiasSteps::coarse);
        }
        return found;
    }

    /// Checks the best setting in all views, with the better of the biases that coarse and fine
    /// steps find.
    void finish()
    {
        TunedSetting& best = considered_[*best_];
        TunedSetting unset = best;
        unset.bias = {};
        BiasSearch search{world_.file, world_.renderers, world_.views.turns_light};
        add_views(search, world_.job, unset, world_.views, world_.views.views.size());
        const auto slope = static_cast<float>(best.slope);
        if (best.bias.outcomes.size() < world_.views.views.size()) {
            best.bias = search.find(world_.limits, slope, BiasSteps::coarse);
        }
        TunedSetting fine = best;
        fine.bias = search.find(world_.limits, slope, BiasSteps::fine);
        if (is_less_wrong(fine, best)) {
            best.bias = fine.bias;
        }
        found_.measured = search.measure(best.bias.constant(), slope);
        found_.best = best;
        found_.index = *best_;
    }

    World world_;
    std::vector<TunedSetting>& considered_;
    const std::function<void(const TunedSetting&)>& progress_;
    std::map<std::string, std::size_t> known_; ///< by keys: index into `considered_`
    std::optional<std::size_t> best_;          ///< index into `considered_`
    TunedMethod found_;
};

} // namespace

bool is_less_wrong(const TunedSetting& a, const TunedSetting& b)
{
    const auto order = [](const TunedSetting& setting) {
        // Failing settings were checked only in the job's own view.
        const ViewOutcome pooled =
            setting.meets_limits() ? setting.pooled() : setting.bias.outcomes.front();
        return std::tuple{!setting.meets_limits(), pooled.error_rate().value_or(0), setting.cost,
                          pooled.metrics.error_rate.value_or(0), -setting.bias.run.width()};
    };
    return order(a) < order(b);
}

std::vector<std::string> changed_keys(const Job& from, const Job& to)
{
    const auto before = scene::resolved_keys(from);
    std::vector<std::string> changed;
    for (const auto& key : scene::resolved_keys(to)) {
        if (std::ranges::find(before, key) == before.end()) {
            changed.push_back(fmt::format("{} = {}", key.first, key.second));
        }
    }
    return changed;
}

TuneResult tune_methods(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
                        const CheckedViews& views, const TuneLimits& limits,
                        const MethodRequest& request, const MethodProgress& progress)
{
    TuneResult result{.nothing = why_nothing(views)};
    result.limits = limits;
    if (!result.nothing.empty()) {
        return result;
    }
    MethodRanking ranking;
    ranking.max_bytes = bytes_allowed(job, file, request);
    std::deque<MethodSpace> spaces;
    for (const std::string& name : request.methods) {
        spaces.emplace_back(job, name, file, views,
                            MapBudget{ranking.max_bytes, limits.max_resolution_texels});
        ranking.most_settings += spaces.back().most_settings(search_rounds);
    }
    if (progress.begins) {
        progress.begins(spaces.size(), ranking.most_settings, ranking.max_bytes);
    }
    for (std::size_t i = 0; i < spaces.size(); ++i) {
        MethodSearch search{
            {job, file, renderers, views, limits}, result.considered, progress.tried};
        std::string reason;
        if (auto found = search.run(spaces[i], request.methods[i], reason)) {
            ranking.ranked.push_back(*std::move(found));
        } else {
            ranking.passed_over.push_back({request.methods[i], reason});
        }
    }
    if (ranking.ranked.empty()) {
        throw scene::InputError(fmt::format("none of these methods can do this job; {}: {}",
                                            ranking.passed_over.front().method,
                                            ranking.passed_over.front().reason));
    }
    std::ranges::stable_sort(ranking.ranked, is_less_wrong, &TunedMethod::best);
    result.recommended = ranking.ranked.front().index;
    result.measured_views = ranking.ranked.front().measured;
    result.measured =
        compare(with_view_of(tuned_job(job, result.best()), views.own().view.job), file, renderers);
    result.passed_over = views.passed_over;
    std::ranges::transform(views.views, std::back_inserter(result.views), &CheckedView::view);
    result.methods = std::move(ranking);
    return result;
}

} // namespace gnomon::analysis
