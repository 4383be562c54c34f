#pragma once

#include "analysis/advice/checked_views.hpp"
#include "fake_renderers.hpp"
#include "methods/key_table.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace gnomon::analysis {

/// 4 × 2 pixels in front of a sheet: seven lit, and the last one blocked.
inline scene::Job job_of_sheet()
{
    scene::Job job;
    job.keys = methods::key_table();
    job.scene.file = "sheet.obj";
    job.image = {4, 2};
    job.camera = scene::CameraSettings{};
    return job;
}

/// The number of lit pixels that a lookup of the job shadows; may throw to refuse the job.
using CountWrongPixels = std::function<std::size_t(const scene::Job&)>;

/// A scene, and renderers without GL and Embree whose lookups have chosen errors.
class FakeWorld {
public:
    scene::SceneFile file = sheet();
    CountWrongPixels wrong = [](const scene::Job&) { return std::size_t{0}; };

    static scene::SceneFile sheet()
    {
        scene::SceneBuilder builder;
        const std::vector<scene::Vec3d> vertices{{0, 0, 0}, {4, 0, 0}, {0, 0, 3}};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}};
        builder.add("sheet", vertices, triangles);
        return {builder.take(), {}};
    }

    [[nodiscard]] Renderers renderers() const
    {
        if (fake_ == nullptr) {
            fake_ = make_fake();
        }
        return fake_->renderers();
    }
    /// For lookups of another rasterizer.
    [[nodiscard]] std::unique_ptr<tests::FakeRenderers> make_fake() const
    {
        auto fake = std::make_unique<tests::FakeRenderers>();
        fake->rasterizer.on_look_up = [this](const scene::Job& job, const scene::View& view) {
            scene::LookupLayers lookup{
                scene::Image<scene::LookupSample>{view.image, {0, 0, 0, 1.0F}}};
            const std::size_t shadowed = wrong(job);
            for (std::size_t pixel = 0; pixel < shadowed; ++pixel) {
                lookup.samples[pixel].verdict = 0;
            }
            lookup.samples[lookup.samples.pixel_count() - 1].verdict = 0;
            return lookup;
        };
        fake->reference.on_truth = [](const scene::View& view, const scene::ReceiverLayers&) {
            scene::Truth truth;
            truth.pixel_class = scene::Image<scene::PixelClass>{view.image, scene::PixelClass::lit};
            truth.pixel_class[truth.pixel_class.pixel_count() - 1] = scene::PixelClass::blocked;
            truth.reason = scene::Image<scene::ClassReason>{view.image};
            truth.witness = scene::Image<std::uint32_t>{view.image, scene::no_triangle};
            return truth;
        };
        return fake;
    }

    [[nodiscard]] CheckedViews views(const scene::Job& job) const
    {
        return judge_views(job, file, renderers(), {});
    }

private:
    mutable std::shared_ptr<tests::FakeRenderers> fake_; ///< made on first use
};

} // namespace gnomon::analysis
