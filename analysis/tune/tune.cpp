#include "analysis/tune/tune.hpp"

#include "analysis/tune/tune_space.hpp"
#include "scene/error.hpp"
#include "scene/job/handed_key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

using scene::Filter;
using scene::Job;

namespace {

/// With errors this many times above their limit a map is too coarse for culling or filters to
/// help; limits below the floor count as the floor.
constexpr double hopeless_factor = 8;
constexpr double limit_floor = 5e-4;

/// How many times above its limit the worse of the two amounts is.
double times_above(const ViewOutcome& outcome, const TuneLimits& limits)
{
    const auto times = [](const std::optional<double>& rate, double limit) {
        return rate.value_or(0) / std::max(limit, limit_floor);
    };
    return std::max(times(outcome.shadow_rate(), limits.max_shadow_amount_rate),
                    times(outcome.light_rate(), limits.max_light_amount_rate));
}

class Tuner {
public:
    Tuner(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
          const JudgedViews& views, const TuneLimits& limits,
          const std::function<void(const TunedSetting&)>& progress)
        : job_{job},
          file_{file},
          renderers_{renderers},
          views_{views},
          limits_{limits},
          progress_{progress},
          shapes_{distinct_shapes(job, file, views)},
          filters_{tuned_filters(job)}
    {
    }

    TuneResult run()
    {
        if (shapes_.empty()) { // says why
            (void)scene::resolve_view(views_.own().view.job, file_.scene, file_.defaults);
        }
        const auto sizes = map_sizes(job_, limits_);
        if (sizes.empty()) {
            throw scene::InputError(
                fmt::format("--max-resolution {}: no shadow map is that small; allow at least 256",
                            limits_.max_resolution_texels));
        }
        for (auto first = sizes.begin(); first != sizes.end() && !is_done();) {
            const auto last = std::find_if(
                first, sizes.end(), [&](const MapSize& size) { return size.bytes > first->bytes; });
            try_sizes({first, last});
            first = last;
        }
        finish();
        return std::move(result_);
    }

private:
    /// Whether something meets the limits: what comes later takes more bytes or taps.
    [[nodiscard]] bool is_done() const
    {
        return !result_.considered.empty() && result_.meets_limits();
    }

    /// Maps of as many bytes, filters from the fewest taps.
    void try_sizes(std::span<const MapSize> sizes)
    {
        for (const Filter filter : filters_) {
            const int taps = lookup_cost(with_filter(job_, filter)).taps;
            if (is_done() && result_.best().cost.taps < taps) {
                return;
            }
            if (is_costly(filter)) {
                try_best_maps(sizes, filter);
                continue;
            }
            for (const MapSize& size : sizes) {
                if (is_first(filter) || !is_hopeless(size)) {
                    try_size(size, filter);
                }
            }
        }
    }

    /// A costly filter, with the best map of each resolution that cheaper ones have found.
    void try_best_maps(std::span<const MapSize> sizes, Filter filter)
    {
        std::set<std::pair<int, int>> done;
        for (const MapSize& size : sizes) {
            if (is_hopeless(size) || !done.insert({size.resolution_texels, size.cascades}).second) {
                continue;
            }
            const TunedSetting* best = nullptr;
            for (const TunedSetting& setting : result_.considered) {
                const bool is_of_size = setting.map.resolution_texels == size.resolution_texels &&
                                        setting.cost.map_bytes == size.bytes &&
                                        has_cascades(setting.map, size.cascades);
                if (is_of_size && !is_costly(setting.filter) &&
                    (best == nullptr || is_better(setting, *best))) {
                    best = &setting;
                }
            }
            try_map(scene::ShadowMapSettings{best->map}, filter);
        }
    }

    /// Each setting of such a filter costs as much as a hundred others.
    [[nodiscard]] bool is_costly(Filter filter) const
    {
        return !is_first(filter) && methods::promises(with_filter(job_, filter)).has_fractions();
    }
    /// Whether it is the filter of the fewest taps: what it finds tells whether others are tried.
    [[nodiscard]] bool is_first(Filter filter) const { return filter == filters_.front(); }
    [[nodiscard]] bool is_far_from_limits(const TunedSetting& setting) const
    {
        return times_above(setting.bias.outcomes.front(), limits_) > hopeless_factor;
    }

    [[nodiscard]] bool is_hopeless(const MapSize& size) const
    {
        return std::ranges::find(result_.hopeless, size) != result_.hopeless.end();
    }

    /// Whether the maps are so many cascades; any are where the layout is another.
    static bool has_cascades(const scene::ShadowMapSettings& map, int cascades)
    {
        return cascades == 0 || map.cascades.count == cascades;
    }

    /// All shapes with the job's culling; the best of them with other culling.
    void try_size(const MapSize& size, Filter filter)
    {
        const std::size_t first = result_.considered.size();
        for (const MapShape& shape : shapes_) {
            scene::ShadowMapSettings map = job_.shadow_map;
            map.layout = scene::map_layout(scene::with_layout(job_, file_.defaults));
            map.resolution_texels = size.resolution_texels;
            map.depth_format = size.format;
            map.frustum = shape.frustum;
            map.cascades = shape.cascades;
            map.cascades.count = size.cascades > 0 ? size.cascades : map.cascades.count;
            if (can_be_stable(map)) {
                try_map(map, filter);
            }
        }
        const auto best = std::min_element(
            result_.considered.begin() + static_cast<std::ptrdiff_t>(first),
            result_.considered.end(),
            [](const TunedSetting& a, const TunedSetting& b) { return is_better(a, b); });
        if (is_first(filter) && is_far_from_limits(*best)) {
            if (!is_hopeless(size)) {
                result_.hopeless.push_back(size);
            }
            return;
        }
        scene::ShadowMapSettings map = best->map;
        for (const scene::Cull cull : other_culls(job_)) {
            map.cull = cull;
            try_map(map, filter);
        }
    }

    void try_map(const scene::ShadowMapSettings& map, Filter filter)
    {
        for (const double normal_texels : normal_offsets(job_, filter)) {
            TunedSetting setting{map, filter, 0, normal_texels, {}, {}, {}};
            setting.has_filter = !methods::method_of(job_).filters.empty();
            setting.cost = lookup_cost(tuned_job(job_, setting));
            BiasSearch search{file_, renderers_, views_.turns_light};
            add_view(search, setting, views_.own());
            for (const double slope :
                 slopes(job_, filter, search.own_view().first_map(), map.resolution_texels)) {
                setting.slope = slope;
                consider(search, setting);
                if (is_costly(filter) && is_far_from_limits(result_.considered.back())) {
                    return;
                }
            }
        }
    }

    void add_view(BiasSearch& search, const TunedSetting& setting, const JudgedView& judged) const
    {
        search.add_view(with_view_of(tuned_job(job_, setting), judged.view.job), judged);
    }
    void add_other_views(BiasSearch& search, const TunedSetting& setting) const
    {
        for (std::size_t i = search.view_count(); i < views_.views.size(); ++i) {
            add_view(search, setting, views_.views[i]);
        }
    }

    /// What fails the limits in the views looked at so far fails them in all.
    void consider(BiasSearch& search, TunedSetting setting)
    {
        const auto slope = static_cast<float>(setting.slope);
        setting.bias = search.find(limits_, slope);
        if (setting.meets_limits() && search.view_count() < views_.views.size()) {
            add_other_views(search, setting);
            setting.bias = search.find(limits_, slope);
        }
        if (result_.considered.empty() || is_better(setting, result_.best())) {
            result_.recommended = result_.considered.size();
        }
        result_.considered.push_back(setting);
        if (progress_) {
            progress_(setting);
        }
    }

    /// GL's own word on the recommended setting; in all views, also where it meets no limits.
    void finish()
    {
        TunedSetting& best = result_.considered[result_.recommended];
        BiasSearch search{file_, renderers_, views_.turns_light};
        add_other_views(search, best);
        const auto slope = static_cast<float>(best.slope);
        if (best.bias.outcomes.size() < views_.views.size()) {
            best.bias = search.find(limits_, slope);
        }
        result_.measured_views = search.measure(best.bias.constant(), slope);
        const Job& own = views_.own().view.job;
        result_.measured = compare(with_view_of(tuned_job(job_, best), own), file_, renderers_);
        result_.passed_over = views_.passed_over;
        for (const JudgedView& view : views_.views) {
            result_.views.push_back(view.view);
        }
    }

    const Job& job_;
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    const JudgedViews& views_;
    const TuneLimits& limits_;
    const std::function<void(const TunedSetting&)>& progress_;
    std::vector<MapShape> shapes_;
    std::vector<Filter> filters_;
    TuneResult result_;
};

} // namespace

bool is_better(const TunedSetting& a, const TunedSetting& b)
{
    if (a.meets_limits() != b.meets_limits()) {
        return a.meets_limits();
    }
    const auto cost = [](const TunedSetting& setting) {
        return setting.meets_limits() ? setting.cost : LookupCost{};
    };
    const auto order = [&](const TunedSetting& setting) {
        // What fails was not looked at in all views: the job's own tells them apart.
        const ViewOutcome pooled =
            setting.meets_limits() ? setting.pooled() : setting.bias.outcomes.front();
        return std::tuple{cost(setting), pooled.error_rate().value_or(0),
                          pooled.metrics.error_rate.value_or(0), setting.cost,
                          -setting.bias.run.width()};
    };
    return order(a) < order(b);
}

Job tuned_job(const Job& job, const TunedSetting& setting)
{
    Job tuned = job;
    tuned.method = setting.method.value_or(job.method);
    tuned.shadow_map = setting.map;
    tuned.lookup.filter = setting.filter;
    tuned.bias = {0, std::nullopt, setting.slope, setting.normal_texels};
    if (!scene::has_key(tuned.method.name, "bias.constant")) {
        return tuned;
    }
    const bool is_found = !setting.bias.outcomes.empty();
    tuned.bias.constant_m = is_found ? setting.bias.pasted.constant_m : job.bias.constant_m;
    if (!scene::scales_bias(tuned)) { // else it is as long in each map
        tuned.bias.constant_m.reset();
        tuned.bias.constant = is_found ? double{setting.bias.constant()} : 0;
    } else if (!is_found) {
        tuned.bias.constant_m = 0;
    }
    return tuned;
}

TuneResult tune(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
                const JudgedViews& views, const TuneLimits& limits,
                const std::function<void(const TunedSetting&)>& progress)
{
    return Tuner{job, file, renderers, views, limits, progress}.run();
}

} // namespace gnomon::analysis
