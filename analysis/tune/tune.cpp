#include "analysis/tune/tune.hpp"

#include "analysis/sweep/compare.hpp"
#include "analysis/tune/tune_space.hpp"
#include "analysis/tune/tuned_setting.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

using scene::Filter;
using scene::Job;

namespace {

/// The share of the time for trying settings; the rest is for the final measurements in GL.
constexpr double search_share = 0.7;
/// The share after which no filter is begun whose settings each cost as much as many others.
constexpr double costly_share = 0.6;
/// Shapes from which the search goes down.
constexpr std::size_t most_shapes_down = 2;

/// One map, filter and normal offset, to try with every slope.
struct Candidate {
    scene::ShadowMapSettings map;
    Filter filter = Filter::nearest;
    double normal_texels = 0;
};

class Tuner {
public:
    Tuner(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
          const CheckedViews& views, const TuneGoal& goal,
          const std::function<void(const TunedSetting&)>& progress)
        : job_{scene::with_layout(with_view_of(job, views.own().view.job), file.defaults)},
          base_job_{job},
          file_{file},
          renderers_{renderers},
          views_{views},
          goal_{goal},
          progress_{progress},
          filters_{tuned_filters(job)},
          tried_{goal}
    {
        job_.shadow_map.layout = scene::map_layout(job_);
    }

    TuneResult run()
    {
        (void)scene::resolve_view(job_, file_.scene,
                                  file_.defaults); // throws if the job is invalid
        if (tuned_resolutions(job_, goal_.max_resolution_texels).empty()) {
            throw scene::InputError(fmt::format(
                "no map is as small as {} texels; allow at least {}", goal_.max_resolution_texels,
                scene::map_count(job_) > 1 ? 2 * smallest_side : smallest_side));
        }
        if (job_.shadow_map.resolution_texels <= goal_.max_resolution_texels) {
            try_own();
        }
        try_shapes();
        try_culls();
        go_down();
        try_filters();
        settle();
        return std::move(result_);
    }

private:
    [[nodiscard]] double seconds() const { return goal_.seconds ? goal_.seconds() : 0; }
    /// Whether time is up. At least one setting is tried.
    bool is_late()
    {
        const bool is_late = !tried_.empty() && seconds() > search_share * goal_.time_s;
        result_.is_cut_short = result_.is_cut_short || is_late;
        return is_late;
    }

    [[nodiscard]] bool is_costly(Filter filter) const
    {
        return methods::traits(with_filter(job_, filter)).has_fractions();
    }

    /// Tries the job as it is, except for its constant bias.
    void try_own()
    {
        const Candidate own{job_.shadow_map, job_.lookup.filter, job_.bias.normal_texels};
        const double slope = job_.bias.slope;
        try_slopes(own, {&slope, 1}, tried_.absolute_limits());
    }

    /// Tries each shape at the largest size, to see what is possible at all.
    void try_shapes()
    {
        for (const MapShape& shape : distinct_shapes(job_, file_, views_)) {
            try_shape(shape, with_shape(job_, shape));
        }
        for (const MapShape& shape : shapes_of_sun(job_, file_, views_)) {
            try_shape(shape, with_shape(job_, shape));
        }
        if (job_.shadow_map.layout == scene::MapLayout::cascades) {
            const scene::ShadowMapSettings best = tried_[tried_.least_wrong()].map;
            for (const int count : {2, 3, 4}) {
                MapShape shape{best.frustum, best.cascades};
                shape.cascades.count = count;
                try_shape(shape, with_shape(job_, shape));
            }
        }
    }

    void try_shape(const MapShape& shape, const Job& shaped)
    {
        scene::ShadowMapSettings map = shaped.shadow_map;
        const std::vector<int> sides = tuned_resolutions(shaped, goal_.max_resolution_texels);
        if (sides.empty()) {
            return; // several maps, none of which is that small
        }
        for (const int side : sides) {
            map.resolution_texels = side;
            if (can_be_stable(map)) {
                break;
            }
        }
        map.depth_format = finest_format();
        const std::size_t first = tried_.size();
        const Filter filter = filters_.front();
        try_offsets(map, filter,
                    is_costly(filter) ? std::vector{job_.bias.normal_texels}
                                      : normal_offsets(job_, filter),
                    tried_.absolute_limits());
        if (first < tried_.size()) {
            shape_bests_.push_back({shape, tried_.least_wrong(first)});
        }
    }

    /// d32f, or the job's own if it has as many bits.
    [[nodiscard]] scene::DepthFormat finest_format() const
    {
        const scene::DepthFormat own = job_.shadow_map.depth_format;
        return own.bits >= scene::float_depth_format.bits ? own : scene::float_depth_format;
    }

    /// Tries other culling with the least wrong shape.
    void try_culls()
    {
        sort_shapes();
        if (shape_bests_.empty()) {
            return;
        }
        const TunedSetting best = tried_[shape_bests_.front().best];
        for (const scene::Cull cull : other_culls(job_)) {
            scene::ShadowMapSettings map = best.map;
            map.cull = cull;
            const std::size_t first = tried_.size();
            try_offsets(map, best.filter, {0.0, best.normal_texels}, tried_.absolute_limits());
            if (first < tried_.size() &&
                tried_.is_less_wrong(tried_.least_wrong(first), shape_bests_.front().best)) {
                shape_bests_.front().best = tried_.least_wrong(first);
            }
        }
    }

    void sort_shapes()
    {
        std::ranges::stable_sort(shape_bests_, [&](const ShapeBest& a, const ShapeBest& b) {
            return tried_.is_less_wrong(a.best, b.best);
        });
    }

    /// Goes from the least wrong shapes to fewer bytes while the limits are met.
    void go_down()
    {
        for (std::size_t i = 0; i < std::min(shape_bests_.size(), most_shapes_down); ++i) {
            const TunedSetting top = tried_[shape_bests_[i].best];
            const Job shaped = with_shape(job_, shape_bests_[i].shape);
            for (const int side : tuned_resolutions(shaped, goal_.max_resolution_texels)) {
                scene::ShadowMapSettings map = top.map;
                map.resolution_texels = side;
                const bool is_smaller = side <= top.map.resolution_texels;
                if (is_smaller && can_be_stable(map) && !any_format_meets(map, top)) {
                    break;
                }
            }
        }
    }

    /// Whether the map meets the limits in some format, tried from the fewest bytes.
    bool any_format_meets(scene::ShadowMapSettings map, const TunedSetting& top)
    {
        for (const scene::DepthFormat format : tuned_formats(job_)) {
            map.depth_format = format;
            try_offsets(map, top.filter, {0.0, top.normal_texels}, tried_.limits());
            if (is_met_by(map, top.filter)) {
                return true;
            }
            if (is_late()) {
                return false;
            }
        }
        return false;
    }

    /// Whether some setting with this map and filter meets the limits, tried now or earlier.
    [[nodiscard]] bool is_met_by(const scene::ShadowMapSettings& map, Filter filter) const
    {
        const std::string wanted = map_text(map);
        const TuneLimits limits = tried_.limits();
        for (std::size_t i = 0; i < tried_.size(); ++i) {
            const TunedSetting& setting = tried_[i];
            if (setting.filter == filter && meets_in_its_views(setting, limits) &&
                map_text(setting.map) == wanted) {
                return true;
            }
        }
        return false;
    }

    /// Tries other filters with half and a quarter of the side of the cheapest map that meets the
    /// limits: they read more texels, but store fewer bytes.
    void try_filters()
    {
        const std::optional<std::size_t> cheapest = tried_.cheapest_meeting(tried_.limits());
        if (!cheapest) {
            return;
        }
        const TunedSetting from = tried_[*cheapest];
        for (const Filter filter : filters_) {
            const bool is_too_costly = is_costly(filter) && seconds() > costly_share * goal_.time_s;
            result_.is_cut_short = result_.is_cut_short || is_too_costly;
            // Only the exact truth tells softening from errors.
            const bool can_judge = !is_costly(filter) || renderers_.reference.has_light_queries();
            if (filter == from.filter || is_too_costly || !can_judge) {
                continue;
            }
            for (const int divisor : {2, 4}) {
                scene::ShadowMapSettings map = from.map;
                map.resolution_texels /= divisor;
                if (map.resolution_texels >= smallest_side && can_be_stable(map)) {
                    try_offsets(map, filter, {from.normal_texels}, tried_.limits());
                }
            }
        }
    }

    void try_offsets(const scene::ShadowMapSettings& map, Filter filter,
                     const std::vector<double>& normal_texels, const TuneLimits& limits)
    {
        const std::set<double> offsets(normal_texels.begin(), normal_texels.end());
        for (const double offset : offsets) {
            try_slopes({map, filter, offset}, {}, limits);
        }
    }

    /// Tries a candidate with the given slopes, or with those that suit its map.
    void try_slopes(const Candidate& candidate, std::span<const double> slopes_given,
                    const TuneLimits& limits)
    {
        const auto key = std::tuple{map_text(candidate.map), candidate.filter,
                                    candidate.normal_texels, slopes_given.empty()};
        if (is_late() || !known_.insert(key).second) {
            return;
        }
        TunedSetting setting{
            candidate.map, candidate.filter, 0, candidate.normal_texels, {}, {}, {}};
        setting.has_filter = !methods::method_of(job_).filters.empty();
        const scene::FrustumSettings& own = job_.shadow_map.frustum;
        setting.sets_half_extent = candidate.map.frustum.fit == scene::Fit::fixed &&
                                   (own.fit != scene::Fit::fixed ||
                                    candidate.map.frustum.half_extent_m != own.half_extent_m);
        setting.cost = lookup_cost(tuned_job(job_, setting));
        BiasSearch search{file_, renderers_, views_.turns_light};
        add_views(search, base_job_, setting, views_, 1);
        const std::vector<double> all =
            slopes_given.empty() ? slopes(job_, candidate.filter, search.own_view().first_map(),
                                          candidate.map.resolution_texels)
                                 : std::vector<double>(slopes_given.begin(), slopes_given.end());
        for (const double slope : all) {
            if (is_costly(candidate.filter) && slope != all.front() && is_late()) {
                return;
            }
            setting.slope = slope;
            setting.bias = search.find(limits, static_cast<float>(slope));
            tried_.add(setting);
            if (progress_) {
                progress_(setting);
            }
        }
    }

    /// A map's keys, which identify it.
    [[nodiscard]] std::string map_text(const scene::ShadowMapSettings& map) const
    {
        Job job = job_;
        job.shadow_map = map;
        std::string text;
        for (const auto& [name, value] : scene::resolved_keys(job)) {
            text += name.starts_with("shadow_map.") ? value + "\n" : std::string{};
        }
        return text;
    }

    /// Checks a setting in every view, unless it was.
    void look_in_all_views(TunedSetting& setting, const TuneLimits& limits) const
    {
        if (setting.bias.outcomes.size() == views_.views.size()) {
            return;
        }
        BiasSearch search{file_, renderers_, views_.turns_light};
        TunedSetting unset = setting;
        unset.bias = {};
        add_views(search, base_job_, unset, views_, views_.views.size());
        setting.bias = search.find(limits, static_cast<float>(setting.slope));
    }

    /// Determines the limits and the cheapest setting that meets them in all views, and measures it
    /// in GL.
    void settle()
    {
        result_.least_wrong = tried_.least_wrong();
        look_in_all_views(tried_[result_.least_wrong], tried_.absolute_limits());
        result_.limits = limits_of(goal_, tried_[result_.least_wrong].bias.outcomes);
        result_.relative_limits =
            (goal_.max_shadow_amount_rate ? 0 : 1) + (goal_.max_light_amount_rate ? 0 : 1);
        result_.time_s = goal_.time_s;
        result_.recommended = cheapest_in_all_views().value_or(result_.least_wrong);
        result_.considered = tried_.take();
        for (TunedSetting& setting : result_.considered) {
            setting.bias.meets_limits = meets_in_its_views(setting, result_.limits) &&
                                        setting.bias.outcomes.size() == views_.views.size();
        }
        measure();
    }

    /// Checks the cheapest settings in all views, in turn, until one meets the limits there.
    [[nodiscard]] std::optional<std::size_t> cheapest_in_all_views()
    {
        while (const auto cheapest = tried_.cheapest_meeting(result_.limits)) {
            TunedSetting& setting = tried_[*cheapest];
            if (setting.bias.outcomes.size() == views_.views.size()) {
                return cheapest;
            }
            look_in_all_views(setting, result_.limits);
        }
        return std::nullopt;
    }

    void measure()
    {
        const TunedSetting& best = result_.best();
        TunedSetting unset = best;
        unset.bias = {};
        BiasSearch search{file_, renderers_, views_.turns_light};
        add_views(search, base_job_, unset, views_, views_.views.size());
        result_.measured_views =
            search.measure(best.bias.constant(), static_cast<float>(best.slope));
        const Job& own = views_.own().view.job;
        result_.measured =
            compare(with_view_of(tuned_job(base_job_, best), own), file_, renderers_);
        result_.passed_over = views_.passed_over;
        for (const CheckedView& view : views_.views) {
            result_.views.push_back(view.view);
        }
    }

    static constexpr int smallest_side = 256;

    /// A shape, and its best setting at the largest size.
    struct ShapeBest {
        MapShape shape;
        std::size_t best = 0; ///< index
    };

    Job job_; ///< with camera, light and layout written out
    const Job& base_job_;
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    const CheckedViews& views_;
    const TuneGoal& goal_;
    const std::function<void(const TunedSetting&)>& progress_;
    std::vector<Filter> filters_;
    std::vector<ShapeBest> shape_bests_;
    std::set<std::tuple<std::string, Filter, double, bool>> known_; ///< candidates
    TriedSettings tried_;
    TuneResult result_;
};

} // namespace

double TuneResult::most_lit() const
{
    double most = 0;
    for (const ViewOutcome& view : measured_views) {
        most = std::max(most, view.light_rate().value_or(0));
    }
    return most;
}

bool TuneResult::recommends() const
{
    return nothing.empty() && (meets_limits() || most_lit() <= most_relative_limit);
}

TuneResult tune(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
                const CheckedViews& views, const TuneGoal& goal,
                const std::function<void(const TunedSetting&)>& progress)
{
    if (std::string nothing = why_nothing(views); !nothing.empty()) {
        TuneResult result{.nothing = std::move(nothing)};
        result.limits = limits_of(goal, {});
        return result;
    }
    return Tuner{job, file, renderers, views, goal, progress}.run();
}

} // namespace gnomon::analysis
