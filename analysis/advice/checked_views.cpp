#include "analysis/advice/checked_views.hpp"

#include "analysis/pixels/receiver_geometry.hpp"
#include "analysis/pixels/statistics.hpp"
#include "scene/error.hpp"
#include "scene/view/nearby_cameras.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace gnomon::analysis {

using scene::Job;

namespace {

constexpr double least_share = 0.1; // of the scored pixels of the job's own view
constexpr int most_tries = 4;       // for each requested view

/// The job with explicit camera and light, even if the scene file provides them.
Job with_own_view(const Job& job, const scene::SceneFile& file)
{
    Job own = job;
    own.light = scene::resolve_light(job, file.defaults);
    own.camera = scene::resolve_camera(job, file.scene, file.defaults);
    return own;
}

double median_light_distance_m(const CheckedView& judged, const scene::View& view,
                               const scene::TriangleScene& triangles)
{
    const ReceiverGeometry geometry{triangles, view, judged.receivers.triangle};
    const auto light_distance_m = light_distances_m(judged.truth.pixel_class, geometry);
    const auto quantiles =
        find_quantiles(std::vector<float>(light_distance_m.begin(), light_distance_m.end()));
    return quantiles ? double{quantiles->median} : 0;
}

class ViewChecker {
public:
    ViewChecker(const scene::SceneFile& file, const Renderers& renderers)
        : file_{file},
          renderers_{renderers}
    {
    }

    /// Adds the view if it scores enough, relative to the first.
    /// @param least  The smallest share of the first view's scored pixels.
    bool add(AdviceView view, double least = least_share)
    {
        const scene::View resolved = scene::resolve_view(view.job, file_.scene, file_.defaults);
        const auto receivers = renderers_.rasterizer.draw_receivers(resolved);
        CheckedView judged{std::move(view), receivers->layers(), {}, {}, 0};
        judged.truth =
            renderers_.reference.find_truth(resolved, judged.receivers, receivers->raster_facts());
        judged.pixels = count_classes(judged.truth);
        const bool scores_enough =
            found_.views.empty() || static_cast<double>(judged.pixels.scored()) >=
                                        least * static_cast<double>(found_.own().pixels.scored());
        if (scores_enough) {
            judged.median_light_distance_m = median_light_distance_m(judged, resolved, file_.scene);
            found_.views.push_back(std::move(judged));
        }
        return scores_enough;
    }

    /// Adds `count` views of a sequence, which may skip some.
    void add_generated(int count,
                       const std::function<std::optional<AdviceView>(std::uint32_t)>& generate)
    {
        int added = 0;
        for (int k = 1; added < count && k <= most_tries * count; ++k) {
            bool is_added = false;
            try {
                auto view = generate(static_cast<std::uint32_t>(k));
                is_added = view && add(std::move(*view));
            } catch (const scene::InputError&) {
                // The job's own keys do not suit this position: its up, or its near and far.
            }
            ++(is_added ? added : passed_over_);
        }
    }

    [[nodiscard]] CheckedViews take()
    {
        found_.passed_over = static_cast<std::size_t>(passed_over_);
        return std::move(found_);
    }
    [[nodiscard]] const CheckedViews& found() const { return found_; }

private:
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    CheckedViews found_;
    int passed_over_ = 0;
};

void require_scored(const CheckedView& view)
{
    if (view.pixels.scored() == 0) {
        throw scene::InputError(fmt::format(
            "camera{}: no visible surface faces the light, so no pixel is scored; aim it at "
            "lit or shadowed surfaces",
            view.view.name == "own" ? "" : fmt::format(" of {}", view.view.name)));
    }
}

void require_turnable(const Job& own, int lights)
{
    if (lights > 0 && scene::shines_all_round(own.light->type)) {
        throw scene::InputError("other lights: the job's light is a point light, which has no "
                                "direction to vary; request none");
    }
}

} // namespace

Job with_view_of(Job job, const Job& view)
{
    job.camera = view.camera;
    job.light = view.light;
    job.image = view.image;
    return job;
}

CheckedViews judge_views(const Job& job, const scene::SceneFile& file, const Renderers& renderers,
                         const ViewRequest& request)
{
    ViewChecker judge{file, renderers};
    const Job own = with_own_view(job, file);
    require_turnable(own, request.lights);
    judge.add({"own", own});
    require_scored(judge.found().own());
    for (const AdviceView& one : request.cases) {
        judge.add({one.name, with_own_view(one.job, file)}, 0);
        require_scored(judge.found().views.back());
    }
    const scene::CameraSettings turning = scene::aimed_camera(job, file.scene, file.defaults);
    const double lowest_m = std::min(file.scene.bounds().lower.y, turning.eye.y);
    judge.add_generated(request.cameras, [&](std::uint32_t k) -> std::optional<AdviceView> {
        AdviceView view{fmt::format("camera {}", k), own};
        view.job.camera = scene::nearby_camera(turning, k);
        return view.job.camera->eye.y < lowest_m ? std::nullopt : std::optional{view};
    });
    judge.add_generated(request.lights, [&](std::uint32_t k) -> std::optional<AdviceView> {
        AdviceView view{fmt::format("light {}", k), own};
        view.job.light = scene::nearby_light(*own.light, k);
        return view;
    });
    CheckedViews views = judge.take();
    const auto& lit = *own.light;
    views.turns_light = std::ranges::any_of(views.views, [&](const CheckedView& view) {
        const scene::LightSettings& light = *view.view.job.light;
        return light.direction != lit.direction || light.position != lit.position ||
               light.target != lit.target;
    });
    return views;
}

} // namespace gnomon::analysis
