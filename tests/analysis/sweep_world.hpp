#pragma once

#include "analysis/lookup/bias_order.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/renderers.hpp"
#include "analysis/sweep/stage_keys.hpp"
#include "fake_light.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/fnv1a.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/infinity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// A world whose depths and classes are hashes of everything they depend on, and renderers that see
/// it as GL and Embree would. A lookup reads the map and receivers that it is given, whatever the
/// job says.
class SweepWorld {
public:
    /// Called before each stage with its name; may throw.
    std::function<void(std::string_view stage, const scene::Job*, const scene::View&)> before_stage;
    std::vector<std::string> calls; ///< of GL and of the truth

    SweepWorld()
    {
        scene::SceneBuilder builder;
        const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 2, 1}};
        const std::vector<scene::Vec3d> ground{{-50, 0, -50}, {50, 0, -50}, {0, 0, 50}};
        const std::vector<scene::Vec3d> roof{{-1, 1, -1}, {1, 1, -1}, {0, 1, 1}};
        builder.add("ground", ground, triangle);
        builder.add("roof", roof, triangle);
        file_.scene = builder.take();
    }
    SweepWorld(const SweepWorld&) = delete;
    SweepWorld& operator=(const SweepWorld&) = delete;

    [[nodiscard]] const scene::SceneFile& file() const { return file_; }
    [[nodiscard]] const Renderers& renderers() const { return renderers_; }

private:
    struct Receivers final : renderers::Receivers {
        explicit Receivers(const scene::View& view)
            : image{view.image},
              eye{view.camera.eye},
              light_clip{view.first_map().light_clip_from_world}
        {
        }
        [[nodiscard]] scene::ReceiverLayers layers() const override
        {
            return {scene::Image<std::uint32_t>{image, 0}};
        }

        scene::ImageSize image;
        scene::Vec3d eye;
        scene::Mat4f light_clip;
    };
    /// A map of the job's key.
    struct Map final : renderers::ShadowMap {
        Map(SweepWorld& the_world, const scene::Job& job)
            : world{the_world},
              key{stage_keys(job).map}
        {
            const int side = job.shadow_map.resolution_texels;
            texels = scene::Image<float>{{side, side}};
            for (std::size_t i = 0; i < texels.pixel_count(); ++i) {
                texels[i] = draw_depth(fmt::format("d {} {}", key, i));
            }
        }
        Map(const Map&) = delete;
        Map& operator=(const Map&) = delete;
        ~Map() override { world.calls.emplace_back("map ends"); }
        [[nodiscard]] scene::Image<float> depths() const override { return texels; }

        SweepWorld& world;
        std::string key;
        scene::Image<float> texels;
    };
    /// The map of a request.
    static const Map& map_of(const renderers::LookupRequest& request)
    {
        return dynamic_cast<const Map&>(request.drawn.map->map());
    }

    /// A number below `most` that depends only on the text.
    static std::uint64_t draw(const std::string& text, std::uint64_t most)
    {
        scene::Fnv1a hash;
        hash.add(text);
        // Only here do the last bytes reach the upper bits.
        return (hash.value() * 0x9E3779B97F4A7C15ULL >> 32U) % most;
    }
    /// A depth from few values, so that pixels change at common biases.
    static float draw_depth(const std::string& text)
    {
        return static_cast<float>(draw(text, 17)) / 16.0F;
    }
    static std::string camera_text(const scene::View& view)
    {
        return fmt::format("{} {} {}", view.camera.eye.x, view.camera.eye.y, view.camera.eye.z);
    }
    static std::string light_text(const scene::View& view)
    {
        return fmt::format("{} {} {}", view.first_map().near_m, view.first_map().far_m,
                           view.first_map().reversed);
    }
    static float receiver_depth(const scene::View& view, std::size_t pixel)
    {
        const std::string text =
            fmt::format("r {} {} {}", camera_text(view), light_text(view), pixel);
        // Some receivers lie beyond far.
        return draw(text + "far", 11) == 0 ? (view.first_map().reversed ? -0.25F : 1.25F)
                                           : draw_depth(text);
    }
    static scene::Vec2f texel_of(const scene::Job& job, const scene::View& view, std::size_t pixel)
    {
        const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
        const std::string text = fmt::format("t {} {}", camera_text(view), pixel);
        // From one texel before the map to one behind it.
        return {static_cast<float>(draw(text + "x", side + 2)) - 0.5F + view.bias.normal_texels,
                static_cast<float>(draw(text + "y", side + 2)) - 0.5F};
    }

    /// A lookup in a map.
    class Lookup {
    public:
        Lookup(const scene::Image<float>& map, const scene::Job& job, const scene::View& view)
            : map_{map},
              job_{job},
              view_{view}
        {
        }
        [[nodiscard]] scene::LookupSample sample(std::size_t pixel) const
        {
            const scene::Vec2f texel = texel_of(job_, view_, pixel);
            scene::LookupSample sample;
            sample.receiver_depth = receiver_depth(view_, pixel);
            const float r = sample.receiver_depth;
            const bool is_far = view_.first_map().reversed ? r < 0 : r > 1;
            if (job_.lookup.outside == scene::Outside::clamp) {
                sample.receiver_depth = std::clamp(r, 0.0F, 1.0F);
            }
            sample.tan_theta = static_cast<float>(draw(fmt::format("tan {}", pixel), 4)) * 0.5F;
            sample.map_depth = depth_at(texel, 0, 0);
            const bool is_border = job_.lookup.outside != scene::Outside::clamp && is_far;
            if (is_border) {
                sample.map_depth = std::numeric_limits<float>::quiet_NaN();
            }
            sample.verdict = is_border ? border() : verdict(sample, texel);
            return sample;
        }

    private:
        [[nodiscard]] float border() const
        {
            return job_.lookup.outside == scene::Outside::lit ? 1.0F : 0.0F;
        }
        /// NaN if the border decides.
        [[nodiscard]] float depth_at(scene::Vec2f texel, int dx, int dy) const
        {
            const int last = job_.shadow_map.resolution_texels - 1;
            int x = static_cast<int>(std::floor(texel.x)) + dx;
            int y = static_cast<int>(std::floor(texel.y)) + dy;
            if (job_.lookup.outside == scene::Outside::clamp) {
                x = std::clamp(x, 0, last);
                y = std::clamp(y, 0, last);
            }
            return x < 0 || y < 0 || x > last || y > last ? std::numeric_limits<float>::quiet_NaN()
                                                          : map_(x, last - y);
        }
        [[nodiscard]] float tap(float r, float d, float bias) const
        {
            if (std::isnan(d)) {
                return border();
            }
            return (view_.first_map().reversed ? r + bias >= d : r - bias <= d) ? 1.0F : 0.0F;
        }
        [[nodiscard]] float verdict(const scene::LookupSample& sample, scene::Vec2f texel) const
        {
            const float bias = view_.bias.constant + view_.bias.slope * sample.tan_theta;
            const int radius = methods::filter_traits(job_.lookup.filter).width_texels / 2;
            const bool is_pcf = methods::filter_traits(job_.lookup.filter).equal_taps() > 1;
            if (!is_pcf) {
                return tap(sample.receiver_depth, sample.map_depth, bias);
            }
            float sum = 0;
            for (int y = -radius; y <= radius; ++y) {
                for (int x = -radius; x <= radius; ++x) {
                    sum += tap(sample.receiver_depth, depth_at(texel, x, y), bias);
                }
            }
            return sum /
                   static_cast<float>(methods::filter_traits(job_.lookup.filter).equal_taps());
        }

        const scene::Image<float>& map_;
        const scene::Job& job_;
        const scene::View& view_;
    };

    /// Found by trials, as GL does.
    static float critical_bias(const scene::Image<float>& map, const scene::Job& job,
                               scene::View view, std::size_t pixel)
    {
        const auto is_lit = [&](std::int32_t rank) {
            view.bias.constant = bias_of_rank(rank);
            return scene::is_lit(Lookup{map, job, view}.sample(pixel).verdict);
        };
        if (is_lit(-largest_bias_rank)) {
            return -scene::infinity;
        }
        std::int32_t shadowed = -largest_bias_rank;
        std::int32_t lit = largest_bias_rank + 1;
        while (lit - 1 > shadowed) {
            const std::int32_t middle = std::midpoint(shadowed, lit);
            (is_lit(middle) ? lit : shadowed) = middle;
        }
        return bias_of_rank(lit);
    }

    void begin(std::string_view stage, const scene::Job* job, const scene::View& view)
    {
        calls.emplace_back(stage);
        if (before_stage) {
            before_stage(stage, job, view);
        }
    }

    class Rasterizer final : public renderers::Rasterizer {
    public:
        explicit Rasterizer(SweepWorld& world) : world_{world} {}

        [[nodiscard]] int subpixel_bits() const override { return 8; }
        std::shared_ptr<const renderers::Receivers> draw_receivers(const scene::View& view) override
        {
            world_.begin("receivers", nullptr, view);
            return std::make_shared<Receivers>(view);
        }
        std::shared_ptr<const renderers::ShadowMap>
        draw_map(const scene::Job& job, const scene::View& view,
                 const renderers::MapRequest& request) override
        {
            if (!request.rows) {
                world_.begin("map", &job, view);
            }
            return std::make_shared<Map>(world_, job);
        }
        scene::LookupLayers look_up(const renderers::LookupRequest& request) override
        {
            world_.begin("lookup", &request.job, request.view);
            return SweepWorld::look_up(request);
        }
        scene::Image<float> find_critical_biases(const renderers::LookupRequest& request,
                                                 float /*lit_from*/) override
        {
            scene::Image<float> criticals{request.view.image};
            for (std::size_t pixel = 0; pixel < criticals.pixel_count(); ++pixel) {
                criticals[pixel] =
                    critical_bias(map_of(request).texels, request.job, request.view, pixel);
            }
            return criticals;
        }

    private:
        SweepWorld& world_;
    };

    class Reference final : public renderers::Reference {
    public:
        explicit Reference(SweepWorld& world) : world_{world} {}

        scene::Truth find_truth(const scene::View& view, const scene::ReceiverLayers& /*receivers*/,
                                const renderers::RasterFacts& /*raster*/) const override
        {
            world_.begin("truth", nullptr, view);
            return truth(view);
        }
        std::unique_ptr<renderers::LightQueries>
        make_light_queries(const scene::Job& job, const scene::View& view,
                           const scene::ReceiverLayers& /*receivers*/) const override
        {
            if (world_.before_stage) {
                world_.before_stage("light", &job, view);
            }
            return light(job, view);
        }

    private:
        SweepWorld& world_;
    };

    static scene::Truth truth(const scene::View& view)
    {
        constexpr std::array<scene::PixelClass, 5> classes{
            scene::PixelClass::lit, scene::PixelClass::blocked, scene::PixelClass::lit,
            scene::PixelClass::blocked, scene::PixelClass::attached};
        scene::Truth truth;
        truth.pixel_class = scene::Image<scene::PixelClass>{view.image};
        for (std::size_t i = 0; i < view.image.pixel_count(); ++i) {
            truth.pixel_class[i] =
                classes.at(draw(fmt::format("c {} {}", camera_text(view), i), 5));
        }
        truth.reason = scene::Image<scene::ClassReason>{view.image};
        truth.witness = scene::Image<std::uint32_t>{view.image, scene::no_triangle};
        return truth;
    }

    static scene::LookupLayers look_up(const renderers::LookupRequest& request)
    {
        const scene::Job& job = request.job;
        const scene::View& view = request.view;
        const Map& map = map_of(request);
        const auto& receivers = dynamic_cast<const Receivers&>(*request.drawn.receivers);
        EXPECT_EQ(map.key, stage_keys(job).map) << "looked up in another map";
        EXPECT_EQ(receivers.eye, view.camera.eye) << "read other receivers";
        EXPECT_TRUE(job.lookup.position == scene::LookupPosition::pixel ||
                    receivers.light_clip == view.first_map().light_clip_from_world)
            << "read receivers of another light matrix";
        const Lookup lookup{map.texels, job, view};
        scene::LookupLayers layers{scene::Image<scene::LookupSample>{view.image},
                                   scene::Image<scene::Vec2f>{view.image}};
        for (std::size_t i = 0; i < view.image.pixel_count(); ++i) {
            layers.samples[i] = lookup.sample(i);
            layers.texels[i] = texel_of(job, view, i);
        }
        return layers;
    }

    static std::unique_ptr<renderers::LightQueries> light(const scene::Job& job,
                                                          const scene::View& view)
    {
        auto light = std::make_unique<FakeLight>();
        const std::string key = stage_keys(job).map;
        const int side = job.shadow_map.resolution_texels;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const std::string text = fmt::format("h {} {} {}", key, x, y);
                if (draw(text, 5) != 0) {
                    light->hits[{x, y}] = {1, double{draw_depth(text)},
                                           view.first_map().near_m +
                                               static_cast<double>(x + y) / 8};
                }
            }
        }
        for (std::size_t i = 0; i < view.image.pixel_count(); ++i) {
            const std::string text = fmt::format("p {} {}", camera_text(view), i);
            light->pixel_depths[i] = double{receiver_depth(view, i)};
            light->places[i] = texel_of(job, view, i);
            light->blockers[i] = {1, 0.25 * static_cast<double>(1 + draw(text, 7)), 2.0, 3.0};
            if (draw(text + "crossed", 2) == 0) {
                light->crossed.insert(i);
            }
            if (draw(text + "own", 2) == 0) {
                light->own.insert({i, 1});
            }
        }
        return light;
    }

    scene::SceneFile file_;
    Rasterizer rasterizer_{*this};
    Reference reference_{*this};
    Renderers renderers_{rasterizer_, reference_, {}};
};

} // namespace gnomon::analysis
