#include "reference_rt/light/light_queries.hpp"

#include "reference_rt/exact/crossing_depth.hpp"
#include "reference_rt/light/critical_bias.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/lit_point.hpp"
#include "reference_rt/light/map_place.hpp"
#include "reference_rt/light/maps_of_light.hpp"
#include "reference_rt/light/self_shadowing.hpp"
#include "reference_rt/light/texel_first_hits.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "reference_rt/pixels/pixel_packets.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon::reference_rt {

using renderers::BlockerHit;
using renderers::HitDetail;
using renderers::KnownHits;
using renderers::LinearQuery;
using renderers::NearestQuery;
using renderers::ReceiverRule;
using renderers::SelfShadowingQuery;
using renderers::TexelHit;
using scene::Image;
using scene::no_triangle;
using scene::Texel;
using scene::Vec2f;
using scene::Vec3d;
using scene::Vec4f;
using scene::View;

namespace {

Vec4f moved_at(const Image<Vec4f>* moved, std::size_t pixel)
{
    return moved == nullptr ? Vec4f{0} : (*moved)[pixel];
}

/// Answers queries for one of the light's maps.
class LightRays final : public renderers::LightQueries {
public:
    LightRays(const ReferenceScene& reference, const View& view,
              std::shared_ptr<const MapsOfLight> maps, std::size_t map,
              const Image<std::uint32_t>& receivers, scene::Cull cull, const scene::Box& box,
              int threads)
        : reference_{reference.implementation()},
          view_{view},
          maps_{std::move(maps)},
          map_{map},
          seen_{reference_.triangles, view, receivers},
          rays_{maps_->rays[map]},
          depth_{maps_->depths[map]},
          cull_{cull},
          segments_{reference_, view.light},
          checks_{reference_.triangles, *maps_, static_cast<int>(map)},
          place_error_texels_{
              reference_rt::place_error_texels(view.maps[map], box, rays_.resolution_texels())},
          threads_{threads}
    {
    }

    std::vector<TexelHit> first_hits(std::span<const Texel> texels, HitDetail detail) const override
    {
        const TexelFirstHits finder{reference_, *maps_, map_, cull_, detail};
        std::vector<TexelHit> hits(texels.size());
        for_each_texel_run(texels, [&](std::size_t first, std::span<const Texel> run) {
            finder.find(run, std::span{hits}.subspan(first, run.size()));
        });
        reference_.errors.check("first_hits");
        return hits;
    }

    std::vector<TexelHit> first_hits(std::span<const Texel> texels,
                                     const KnownHits& known) const override
    {
        if (known.triangles.size() != texels.size()) {
            throw std::invalid_argument{"first_hits: known: not of these texels"};
        }
        if (known.maps.size() != 1 ||
            !keeps_first_hits(view_.light, known.maps.front(), view_.maps[map_])) {
            return first_hits(texels, HitDetail::placed);
        }
        const KnownHitPlacer placer{reference_.triangles, *maps_, map_};
        std::vector<TexelHit> hits(texels.size());
        for_each_texel_run(texels, [&](std::size_t first, std::span<const Texel> run) {
            const auto triangles = known.triangles.subspan(first, run.size());
            for (const std::uint32_t triangle : triangles) {
                if (triangle != no_triangle) {
                    checks_.triangle(triangle);
                }
            }
            placer.place(run, triangles, std::span{hits}.subspan(first, run.size()));
        });
        trace_rest(texels, hits);
        return hits;
    }

    std::vector<float> receiver_depths(std::span<const std::size_t> pixels,
                                       const scene::MapIndices& /*maps*/,
                                       const Image<Vec4f>* moved) const override
    {
        seen_.check(pixels, "receiver_depths");
        std::vector<float> depths(pixels.size());
        for_each_run_of(pixels, [&](std::size_t i, LitPoint& point) {
            point.move_to(pixels[i], moved_at(moved, pixels[i]));
            depths[i] = point.term().nearest_float();
        });
        return depths;
    }

    std::vector<Vec2f> map_places(std::span<const std::size_t> pixels,
                                  const scene::MapIndices& /*maps*/,
                                  const Image<Vec4f>* moved) const override
    {
        seen_.check(pixels, "map_places");
        std::vector<Vec2f> places(pixels.size());
        for_each_run_of(pixels, [&](std::size_t i, LitPoint& point) {
            point.move_to(pixels[i], moved_at(moved, pixels[i]));
            places[i] = map_place(depth_.rows(), point.receiver(), point.offset(),
                                  rays_.resolution_texels());
        });
        return places;
    }
    double place_error_texels() const override { return place_error_texels_; }

    std::vector<float> texel_depths(std::span<const Texel> texels,
                                    const scene::Vec2d& place) const override
    {
        const MapsOfLight maps{view_, rays_.resolution_texels(), place};
        return depths_of(maps, texels, &TexelFirstHits::find);
    }

    std::vector<float> second_depths(std::span<const Texel> texels) const override
    {
        return depths_of(*maps_, texels, &TexelFirstHits::find_second);
    }

    std::vector<float> critical_biases(std::span<const NearestQuery> queries,
                                       const ReceiverRule& rule) const override
    {
        return find_biases(queries, rule);
    }
    std::vector<float> critical_biases(std::span<const LinearQuery> queries,
                                       const ReceiverRule& rule) const override
    {
        return find_biases(queries, rule);
    }

    std::vector<std::uint8_t> occluded(std::span<const std::size_t> pixels,
                                       const scene::MapIndices& /*maps*/) const override
    {
        return find_crossed(pixels, {&depth_, cull_});
    }

    std::vector<std::uint8_t> occluded_anywhere(std::span<const std::size_t> pixels,
                                                scene::Cull cull) const override
    {
        return find_crossed(pixels, {nullptr, cull});
    }

    std::vector<std::uint8_t>
    are_self_shadowing(std::span<const SelfShadowingQuery> queries) const override
    {
        const SelfShadowingSurface sheet{reference_.triangles, reference_.corner_fans(), rays_};
        std::vector<std::uint8_t> answers(queries.size(), 0);
        for_each_run_of(queries, [&](std::size_t i, LitPoint& point) {
            const auto& [pixel, texel, triangle] = queries[i];
            seen_.check({&pixel, 1}, "are_self_shadowing");
            checks_.texel(texel);
            checks_.triangle(triangle);
            if (triangle == seen_.receivers[pixel]) {
                answers[i] = 1; // the walk starts at its goal
                return;
            }
            point.move_to(pixel);
            const bool is_own =
                point.receiver().delta_sign != 0 && sheet.leads(point.receiver(), texel, triangle);
            answers[i] = is_own ? 1 : 0;
        });
        return answers;
    }

    std::vector<BlockerHit> find_blockers(std::span<const std::size_t> pixels,
                                          scene::Cull cull) const override
    {
        seen_.check(pixels, "find_blockers");
        std::vector<BlockerHit> hits(pixels.size());
        for_each_packet(pixels.size(), threads_, [&](std::size_t first, std::size_t count) {
            SignCounts counts;
            const PixelPacket packet{seen_, pixels.subspan(first, count), counts};
            if (!packet.valid.any()) {
                return;
            }
            const auto contacts =
                trace_segments(reference_, segments_, packet.valid, packet.receivers,
                               SegmentGoal::nearest_blocker, counts, {nullptr, cull});
            for (std::size_t i = 0; i < count; ++i) {
                if (contacts[i].witness != no_triangle) {
                    hits[first + i] = blocker_hit(packet.receivers[i], contacts[i].witness);
                }
            }
        });
        reference_.errors.check("find_blockers");
        return hits;
    }

private:
    /// The depths of the hits that `find` returns, rounded once.
    [[nodiscard]] std::vector<float>
    depths_of(const MapsOfLight& maps, std::span<const Texel> texels,
              void (TexelFirstHits::*find)(std::span<const Texel>, std::span<TexelHit>) const) const
    {
        const TexelFirstHits finder{reference_, maps, map_, cull_, HitDetail::bounded};
        const TapDepths taps{reference_.triangles, maps};
        std::vector<float> depths(texels.size());
        for_each_texel_run(texels, [&](std::size_t first, std::span<const Texel> run) {
            std::vector<TexelHit> hits(run.size());
            (finder.*find)(run, hits);
            for (std::size_t i = 0; i < run.size(); ++i) {
                const TexelHit& hit = hits[i];
                depths[first + i] =
                    taps.nearest_float({run[i], hit.triangle, hit.depth, hit.depth_error});
            }
        });
        reference_.errors.check("texel_depths");
        return depths;
    }

    /// For each pixel 1 if a triangle in scope crosses the open segment P→light; else 0.
    [[nodiscard]] std::vector<std::uint8_t> find_crossed(std::span<const std::size_t> pixels,
                                                         const SegmentScope& scope) const
    {
        seen_.check(pixels, "are_crossed");
        std::vector<std::uint8_t> crossed(pixels.size(), 0);
        for_each_packet(pixels.size(), threads_, [&](std::size_t first, std::size_t count) {
            SignCounts counts;
            const PixelPacket packet{seen_, pixels.subspan(first, count), counts};
            if (!packet.valid.any()) {
                return;
            }
            const auto contacts =
                trace_segments(reference_, segments_, packet.valid, packet.receivers,
                               SegmentGoal::any_blocker, counts, scope);
            for (std::size_t i = 0; i < count; ++i) {
                crossed[first + i] = contacts[i].witness != no_triangle ? 1 : 0;
            }
        });
        reference_.errors.check("are_crossed");
        return crossed;
    }

    /// Calls `run(first, texels)` in parallel for runs of texels; `first` is the index of the run's
    /// first texel.
    template <typename Run>
    void for_each_texel_run(std::span<const Texel> texels, const Run& run) const
    {
        constexpr std::size_t at_once = 16 * packet_size;
        const std::size_t runs = (texels.size() + at_once - 1) / at_once;
        with_threads(threads_, [&] {
            tbb::parallel_for(std::size_t{0}, runs, [&](std::size_t i) {
                const std::size_t first = i * at_once;
                const auto part = texels.subspan(first, std::min(at_once, texels.size() - first));
                for (const Texel& texel : part) {
                    checks_.texel(texel);
                }
                run(first, part);
            });
        });
    }

    /// Traces the texels whose hits have no triangle yet.
    void trace_rest(std::span<const Texel> texels, std::span<TexelHit> hits) const
    {
        std::vector<std::size_t> rest;
        std::vector<Texel> rest_texels;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].triangle == no_triangle) {
                rest.push_back(i);
                rest_texels.push_back(texels[i]);
            }
        }
        const auto found = first_hits(rest_texels, HitDetail::placed);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            hits[rest[i]] = found[i];
        }
    }

    /// Calls `run(i, point)` in parallel for every query. Consecutive queries share `point` and its
    /// state.
    template <typename Query, typename Run>
    void for_each_run_of(std::span<const Query> queries, const Run& run) const
    {
        with_threads(threads_, [&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>{0, queries.size(), 256},
                              [&](const tbb::blocked_range<std::size_t>& range) {
                                  LitPoint point{seen_, depth_, maps_->distance(map_)};
                                  for (std::size_t i = range.begin(); i != range.end(); ++i) {
                                      run(i, point);
                                  }
                              });
        });
    }

    template <typename Query>
    [[nodiscard]] std::vector<float> find_biases(std::span<const Query> queries,
                                                 const ReceiverRule& rule) const
    {
        const CriticalBias critical{TapDepths{reference_.triangles, *maps_}};
        std::vector<float> biases(queries.size());
        for_each_run_of(queries, [&](std::size_t i, LitPoint& point) {
            seen_.check({&queries[i].pixel, 1}, "critical_biases");
            checks_.taps(queries[i]);
            point.move_to(queries[i].pixel, moved_at(rule.moved, queries[i].pixel));
            biases[i] = bias_of(queries[i], critical, point,
                                rule.clamps ? point.term().clamped() : point.term());
        });
        return biases;
    }
    [[nodiscard]] float bias_of(const NearestQuery& query, const CriticalBias& critical,
                                const LitPoint& /*point*/, const DepthTerm& receiver) const
    {
        return critical.find(receiver, query.tap);
    }
    [[nodiscard]] float bias_of(const LinearQuery& query, const CriticalBias& critical,
                                const LitPoint& point, const DepthTerm& receiver) const
    {
        return critical.find(receiver, query.taps,
                             BilinearWeights{depth_.rows(), point.receiver(), point.offset(),
                                             query.first, rays_.resolution_texels()});
    }

    [[nodiscard]] BlockerHit blocker_hit(const Receiver& receiver, std::uint32_t blocker) const
    {
        const scene::Light& light = view_.light;
        const Vec3d point = sharp_point(receiver);
        const Vec3d towards =
            light.has_position() ? -exact_offset(receiver, light.position) : -light.direction;
        const double way =
            crossing_parameter(receiver, corners_of(reference_.triangles, blocker), light);
        return {blocker, way * glm::length(towards), view_.light_distance_m(point + way * towards),
                view_.light_distance_m(point)};
    }

    const ReferenceScene::Implementation& reference_;
    const View& view_;
    std::shared_ptr<const MapsOfLight> maps_;
    std::size_t map_;
    SeenPixels seen_;
    const TexelRays& rays_;
    const LightDepth& depth_;
    scene::Cull cull_;
    SegmentLight segments_;
    QueryChecks checks_;
    double place_error_texels_;
    int threads_;
};

} // namespace

std::unique_ptr<renderers::LightQueries> make_light_queries(const ReferenceScene& reference,
                                                            const View& view,
                                                            const Image<std::uint32_t>& receivers,
                                                            int resolution_texels, scene::Cull cull,
                                                            int threads)
{
    if (!reference.implementation().padded || receivers.size() != view.image) {
        throw std::invalid_argument{"make_exact_light: the reference must serve exact truth, and "
                                    "receivers be of the image's size"};
    }
    if (resolution_texels < 1 || resolution_texels > 16384) {
        throw std::invalid_argument{fmt::format(
            "make_exact_light: resolution_texels = {} is not in [1, 16384]", resolution_texels)};
    }
    std::vector<std::unique_ptr<renderers::LightQueries>> maps;
    const auto of_light = std::make_shared<const MapsOfLight>(view, resolution_texels);
    const scene::Box box = reference.implementation().triangles.bounds();
    for (std::size_t map = 0; map < view.maps.size(); ++map) {
        maps.push_back(std::make_unique<LightRays>(reference, view, of_light, map, receivers, cull,
                                                   box, threads));
    }
    return shadow_map_rays(std::move(maps));
}

} // namespace gnomon::reference_rt
