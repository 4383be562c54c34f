#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/loaded_scene.hpp"
#include "api/sweep/sweep_scenes.hpp"
#include "methods/key_table.hpp"
#include "raster_gl/context.hpp"
#include "renderers/forwarding.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/load/load_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// scaling_parts JOB REPEATS: prints the processor time of each part of a sweep of the job's first
/// bias curve, as lines "part,seconds". Each is the least of the repeats.
namespace gnomon::benchmarks {
namespace {

/// Processor time of all threads of this process [s].
double processor_seconds()
{
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs `work` and adds its processor time to `seconds`. Unlike wall time, it depends little on the
/// machine's other load.
template <typename Work>
auto processor_timed(double& seconds, const Work& work)
{
    const double begin_s = processor_seconds();
    auto result = work();
    seconds += processor_seconds() - begin_s;
    return result;
}

/// Processor time of the parts of one pass [s].
struct Parts {
    double scene = 0;       ///< reading the file
    double hierarchies = 0; ///< GL's buffers and programs, Embree's hierarchies
    double receivers = 0;
    double truth = 0;
    double map = 0;
    double lookup = 0;
    double curve = 0; ///< everything after the lookup: causes, the curve, its rows
};

constexpr double Parts::*part_members[] = {&Parts::scene, &Parts::hierarchies, &Parts::receivers,
                                           &Parts::truth, &Parts::map,         &Parts::lookup,
                                           &Parts::curve};

Parts least(const Parts& a, const Parts& b)
{
    Parts parts;
    for (const auto member : part_members) {
        parts.*member = std::min(a.*member, b.*member);
    }
    return parts;
}

/// Renderers that measure the time of their stages.
class TimedRenderers {
public:
    TimedRenderers(const analysis::Renderers& own, Parts& parts)
        : rasterizer_{own.rasterizer, parts},
          reference_{own.reference, parts},
          renderers_{rasterizer_, reference_, own.environment}
    {
    }
    [[nodiscard]] const analysis::Renderers& renderers() const { return renderers_; }

private:
    class Rasterizer final : public renderers::ForwardingRasterizer {
    public:
        Rasterizer(renderers::Rasterizer& own, Parts& parts)
            : ForwardingRasterizer{own},
              parts_{parts}
        {
        }
        std::shared_ptr<const renderers::Receivers> draw_receivers(const scene::View& view) override
        {
            return processor_timed(parts_.receivers,
                                   [&] { return ForwardingRasterizer::draw_receivers(view); });
        }
        std::shared_ptr<const renderers::ShadowMap>
        draw_map(const scene::Job& job, const scene::View& view,
                 const renderers::MapRequest& request) override
        {
            return processor_timed(
                parts_.map, [&] { return ForwardingRasterizer::draw_map(job, view, request); });
        }
        scene::LookupLayers look_up(const renderers::LookupRequest& request) override
        {
            return processor_timed(parts_.lookup,
                                   [&] { return ForwardingRasterizer::look_up(request); });
        }

    private:
        Parts& parts_;
    };
    class Reference final : public renderers::ForwardingReference {
    public:
        Reference(const renderers::Reference& own, Parts& parts)
            : ForwardingReference{own},
              parts_{parts}
        {
        }
        scene::Truth find_truth(const scene::View& view, const scene::ReceiverLayers& receivers,
                                const renderers::RasterFacts& raster) const override
        {
            return processor_timed(parts_.truth, [&] {
                return ForwardingReference::find_truth(view, receivers, raster);
            });
        }

    private:
        Parts& parts_;
    };

    Rasterizer rasterizer_;
    Reference reference_;
    analysis::Renderers renderers_;
};

/// The first bias curve of a job, and its scene and renderers.
class Subject {
public:
    explicit Subject(const std::filesystem::path& job)
        : space_{scene::read_job_source(job, {}, {}, methods::key_table()), {}},
          curves_{space_, false, "scaling"}
    {
        if (curves_.requests().empty()) {
            throw scene::InputError(curves_.refusals().front().message);
        }
    }

    [[nodiscard]] Parts measure()
    {
        Parts parts;
        const scene::Job job = curves_.job(0);
        session_.reset(); // refers to the file
        file_ = processor_timed(parts.scene, [&] { return scene::load_scene(job.scene); });
        session_ = processor_timed(parts.hierarchies, [&] {
            return std::make_unique<api::LoadedScene>(context_, file_.scene, api::SessionOptions{});
        });
        static_cast<void>(answer(parts)); // warms up: GL allocates at the first draw
        Parts again;
        const double all_s = answer(again);
        again.scene = parts.scene;
        again.hierarchies = parts.hierarchies;
        again.curve = all_s - again.receivers - again.truth - again.map - again.lookup;
        return again;
    }

private:
    /// Runs the curve's sweep, step by step.
    /// @return  Processor time of all steps [s].
    double answer(Parts& parts)
    {
        const std::vector<analysis::CurveRequest> requests{curves_.requests().front()};
        const analysis::SweepPlan plan = analysis::make_plan(requests, 1);
        const TimedRenderers timed{session_->renderers(), parts};
        const auto identity = analysis::identify_scene(curves_.job(0), "hash", file_.defaults);
        std::string failure;
        analysis::SweepHooks hooks;
        hooks.open_scene = [&](const scene::Job&) {
            return analysis::OpenScene{&file_, &timed.renderers()};
        };
        hooks.task = [&](std::size_t) { return curves_.task(0, identity); };
        hooks.record = [](analysis::FinishedCurve&&) {};
        hooks.record_failure = [&](auto, const std::string& message, analysis::Retry) {
            failure = message;
        };
        hooks.should_stop = [] { return false; };
        hooks.counts_cells = false; // as in all large sweeps
        double seconds = 0;
        processor_timed(seconds, [&] { return analysis::run_sweep(plan, hooks); });
        if (!failure.empty()) {
            throw scene::InputError(failure);
        }
        return seconds;
    }

    scene::SweepSpace space_;
    analysis::SweepCurves curves_;
    raster_gl::Context context_;
    scene::SceneFile file_;
    std::unique_ptr<api::LoadedScene> session_;
};

void print(const Parts& parts)
{
    fmt::print("scene,{}\nhierarchies,{}\nreceivers,{}\ntruth,{}\nmap,{}\nlookup,{}\ncurve,{}\n",
               parts.scene, parts.hierarchies, parts.receivers, parts.truth, parts.map,
               parts.lookup, parts.curve);
}

void run(const std::filesystem::path& job, int repeats)
{
    Subject subject{job};
    Parts parts = subject.measure();
    for (int i = 1; i < repeats; ++i) {
        parts = least(parts, subject.measure());
    }
    print(parts);
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    if (argc != 3) {
        fmt::print(stderr, "usage: scaling_parts JOB REPEATS\n");
        return 2;
    }
    try {
        gnomon::benchmarks::run(argv[1], std::stoi(argv[2]));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "scaling_parts: {}\n", error.what());
        return 4;
    }
}
