#include "compared.hpp"

#include "analysis/sweep/compare.hpp"
#include "renderers/forwarding.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"
#include "scene_file_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Several lights share their receivers, and each gives what it gives alone.
namespace gnomon::tests {
namespace {

const std::string three_lights = R"([scene]
builtin = "columns"
[image]
width = 96
height = 64
[shadow_map]
resolution = 128
[[lights]]
name = "sun"
type = "directional"
direction = [-0.4, -1, -0.3]
[[lights]]
name = "torch"
type = "spot"
position = [3, 5, 4]
target = [0, 0, 0]
cone_deg = 70
shadow_map.depth_format = "d16"
bias.constant = 0.001
[[lights]]
name = "lamp"
type = "point"
position = [0.5, 3, 0.7]
lookup.filter = "pcf3"
)";

std::vector<scene::LightJob> jobs_of(const std::string& text)
{
    const scene::test::TemporaryFolder folder;
    return scene::light_jobs(scene::read_job_source(folder.write("job.toml", text), {}));
}

template <typename Pixel>
void expect_equal(const scene::Image<Pixel>& a, const scene::Image<Pixel>& b)
{
    EXPECT_EQ(a.size(), b.size());
    EXPECT_TRUE(std::ranges::equal(a, b));
}

/// Depths and verdicts, as bits.
scene::Image<std::array<std::uint32_t, 3>> verdicts_of(const analysis::Comparison& comparison)
{
    const auto& samples = comparison.lookup.samples;
    scene::Image<std::array<std::uint32_t, 3>> bits{samples.size()};
    for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
        bits[i] = {std::bit_cast<std::uint32_t>(samples[i].verdict),
                   std::bit_cast<std::uint32_t>(samples[i].receiver_depth),
                   std::bit_cast<std::uint32_t>(samples[i].map_depth)};
    }
    return bits;
}

struct Passes {
    int receivers = 0;
    int maps = 0;
    int lookups = 0;
    int truths = 0;
};

/// Counts the calls of the renderers.
class CountedRenderers {
public:
    /// @param diagnoses  Whether there are light queries; a diagnosis draws its own maps.
    CountedRenderers(const analysis::Renderers& own, Passes& passes, bool diagnoses)
        : rasterizer_{own.rasterizer, passes},
          reference_{own.reference, passes, diagnoses},
          renderers_{rasterizer_, reference_, own.environment}
    {
    }
    [[nodiscard]] const analysis::Renderers& renderers() const { return renderers_; }

private:
    class Rasterizer final : public renderers::ForwardingRasterizer {
    public:
        Rasterizer(renderers::Rasterizer& own, Passes& passes)
            : ForwardingRasterizer{own},
              passes_{passes}
        {
        }
        std::shared_ptr<const renderers::Receivers> draw_receivers(const scene::View& view) override
        {
            ++passes_.receivers;
            return ForwardingRasterizer::draw_receivers(view);
        }
        std::shared_ptr<const renderers::ShadowMap>
        draw_map(const scene::Job& job, const scene::View& view,
                 const renderers::MapRequest& request) override
        {
            ++passes_.maps;
            return ForwardingRasterizer::draw_map(job, view, request);
        }
        scene::LookupLayers look_up(const renderers::LookupRequest& request) override
        {
            ++passes_.lookups;
            return ForwardingRasterizer::look_up(request);
        }

    private:
        Passes& passes_;
    };
    class Reference final : public renderers::ForwardingReference {
    public:
        Reference(const renderers::Reference& own, Passes& passes, bool diagnoses)
            : ForwardingReference{own},
              passes_{passes},
              diagnoses_{diagnoses}
        {
        }
        scene::Truth find_truth(const scene::View& view, const scene::ReceiverLayers& receivers,
                                const renderers::RasterFacts& raster) const override
        {
            ++passes_.truths;
            return ForwardingReference::find_truth(view, receivers, raster);
        }
        [[nodiscard]] bool has_light_queries() const override { return diagnoses_; }

    private:
        Passes& passes_;
        bool diagnoses_;
    };

    Rasterizer rasterizer_;
    Reference reference_;
    analysis::Renderers renderers_;
};

std::vector<analysis::Comparison> compare_all(const std::vector<scene::LightJob>& lights,
                                              const scene::SceneFile& file,
                                              const analysis::Renderers& renderers)
{
    std::vector<scene::Job> jobs;
    for (const scene::LightJob& light : lights) {
        jobs.push_back(light.job);
    }
    std::vector<analysis::Comparison> comparisons(jobs.size());
    analysis::compare_each(jobs, file, renderers,
                           [&](std::size_t job, analysis::Comparison&& comparison) {
                               comparisons[job] = std::move(comparison);
                           });
    return comparisons;
}

/// The textbook lesson counts "four renderings and three texture maps".
TEST(SeveralLights, ThreeTakeFourRenderingsAndThreeMaps)
{
    const auto jobs = jobs_of(three_lights);
    const Compared compared{jobs.front().job};
    Passes passes;
    const CountedRenderers counted{compared.renderers(), passes, false};
    for (const analysis::Comparison& light :
         compare_all(jobs, compared.file(), counted.renderers())) {
        EXPECT_GT(light.metrics.pixels.scored(), 0U)
            << scene::light_type_name(light.view.light.type);
    }
    EXPECT_EQ(passes.receivers, 1);
    EXPECT_EQ(passes.maps, 3);
    EXPECT_EQ(passes.lookups, 3);
    EXPECT_EQ(passes.truths, 3);
}

/// Vertices carry the light clip coordinates of one light.
TEST(SeveralLights, AtVerticesDrawReceiversForEachLight)
{
    auto jobs = jobs_of(three_lights);
    const Compared compared{jobs.front().job};
    Passes passes;
    const CountedRenderers counted{compared.renderers(), passes, true};
    for (scene::LightJob& job : jobs) {
        job.job.lookup.position =
            job.light == "lamp" ? scene::LookupPosition::pixel : scene::LookupPosition::vertex;
    }
    EXPECT_EQ(compare_all(jobs, compared.file(), counted.renderers()).size(), jobs.size());
    EXPECT_EQ(passes.receivers, 3);
}

void expect_same(const analysis::Comparison& together, const analysis::Comparison& alone)
{
    expect_equal(together.receivers.triangle, alone.receivers.triangle);
    expect_equal(together.truth.pixel_class, alone.truth.pixel_class);
    expect_equal(together.diagnosis->causes.cause, alone.diagnosis->causes.cause);
    expect_equal(verdicts_of(together), verdicts_of(alone));
    EXPECT_EQ(together.diagnosis->curve.points, alone.diagnosis->curve.points);
    EXPECT_EQ(together.metrics.amounts, alone.metrics.amounts);
}

/// With causes, curves and reruns, in either order.
TEST(SeveralLights, EachSeesNothingOfTheOthers)
{
    for (const std::string& position : {std::string{"vertex"}, std::string{"pixel"}}) {
        auto jobs = jobs_of(three_lights);
        for (scene::LightJob& job : jobs) {
            if (job.light != "lamp") {
                job.job.lookup.position = position == "pixel" ? scene::LookupPosition::pixel
                                                              : scene::LookupPosition::vertex;
            }
        }
        std::map<std::string, analysis::Comparison> alone;
        for (const scene::LightJob& job : jobs) {
            alone[job.light] = Compared{job.job}(job.job);
        }
        const Compared compared{jobs.front().job};
        for (int order = 0; order < 2; ++order) {
            const auto all = compare_all(jobs, compared.file(), compared.renderers());
            for (std::size_t i = 0; i < jobs.size(); ++i) {
                SCOPED_TRACE(jobs[i].light + " " + position);
                expect_same(all[i], alone.at(jobs[i].light));
            }
            std::ranges::reverse(jobs);
        }
    }
}

} // namespace
} // namespace gnomon::tests
