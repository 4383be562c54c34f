#pragma once

#include "renderers/light_queries.hpp"
#include "scene/vec.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// Light queries with prescribed answers: depths by texel and by pixel.
class FakeLight final : public renderers::LightQueries {
public:
    std::map<std::pair<int, int>, renderers::TexelHit> hits; ///< by (x, y); others see nothing
    std::map<std::size_t, double> pixel_depths;              ///< by pixel
    std::map<std::size_t, scene::Vec2f> places;              ///< uv·resolution, by pixel
    double place_error = -1; ///< error of GL's places [texels]; negative: GL's places are exact
    std::set<std::size_t> crossed;                              ///< pixels
    std::set<std::pair<std::size_t, std::uint32_t>> own;        ///< pixel and triangle
    std::map<std::size_t, renderers::BlockerHit> blockers;      ///< by pixel
    std::map<std::size_t, renderers::BlockerHit> blockers_left; ///< under any culling
    mutable std::size_t traced_texels = 0;
    mutable std::vector<scene::LightFrustum>
        known_frusta; ///< frusta of the known hits, for each call
    mutable std::vector<std::vector<std::uint32_t>> known_triangles;

    [[nodiscard]] std::vector<renderers::TexelHit>
    first_hits(std::span<const scene::Texel> texels, renderers::HitDetail /*detail*/) const override
    {
        traced_texels += texels.size();
        return answer<renderers::TexelHit>(texels, [&](const scene::Texel& t) { return hit(t); });
    }

    [[nodiscard]] std::vector<renderers::TexelHit>
    first_hits(std::span<const scene::Texel> texels,
               const renderers::KnownHits& known) const override
    {
        known_frusta.push_back(known.maps.front());
        known_triangles.emplace_back(known.triangles.begin(), known.triangles.end());
        return answer<renderers::TexelHit>(texels, [&](const scene::Texel& t) { return hit(t); });
    }

    [[nodiscard]] std::vector<float>
    receiver_depths(std::span<const std::size_t> pixels, const scene::MapIndices& /*maps*/,
                    const scene::Image<scene::Vec4f>* moved) const override
    {
        return answer<float>(pixels, [&](std::size_t p) { return receiver(p, {false, moved}); });
    }

    /// The prescribed places.
    [[nodiscard]] std::vector<scene::Vec2f>
    map_places(std::span<const std::size_t> pixels, const scene::MapIndices& /*maps*/,
               const scene::Image<scene::Vec4f>* /*moved*/) const override
    {
        return answer<scene::Vec2f>(pixels, [&](std::size_t p) { return places.at(p); });
    }
    [[nodiscard]] double place_error_texels() const override { return place_error; }

    [[nodiscard]] std::vector<float> texel_depths(std::span<const scene::Texel> texels,
                                                  const scene::Vec2d& /*place*/) const override
    {
        return answer<float>(texels, [&](const scene::Texel& t) { return hit(t).depth; });
    }

    /// There is no second surface.
    [[nodiscard]] std::vector<float>
    second_depths(std::span<const scene::Texel> texels) const override
    {
        return std::vector<float>(texels.size(), 1.0F);
    }

    [[nodiscard]] std::vector<float>
    critical_biases(std::span<const renderers::NearestQuery> queries,
                    const renderers::ReceiverRule& rule) const override
    {
        return answer<float>(queries, [&](const renderers::NearestQuery& q) {
            return static_cast<float>(receiver(q.pixel, rule) - depth(q.tap));
        });
    }

    [[nodiscard]] std::vector<float>
    critical_biases(std::span<const renderers::LinearQuery> queries,
                    const renderers::ReceiverRule& rule) const override
    {
        return answer<float>(queries, [&](const renderers::LinearQuery& q) {
            const scene::Vec2f place = places.at(q.pixel);
            const double x = std::clamp(double{place.x} - 0.5 - q.first.x, 0.0, 1.0);
            const double y = std::clamp(double{place.y} - 0.5 - q.first.y, 0.0, 1.0);
            return static_cast<float>(
                receiver(q.pixel, rule) -
                ((1 - y) * ((1 - x) * depth(q.taps[0]) + x * depth(q.taps[1])) +
                 y * ((1 - x) * depth(q.taps[2]) + x * depth(q.taps[3]))));
        });
    }

    [[nodiscard]] std::vector<std::uint8_t>
    occluded(std::span<const std::size_t> pixels, const scene::MapIndices& /*maps*/) const override
    {
        return answer<std::uint8_t>(pixels, [&](std::size_t p) { return crossed.contains(p); });
    }

    [[nodiscard]] std::vector<std::uint8_t> occluded_anywhere(std::span<const std::size_t> pixels,
                                                              scene::Cull /*cull*/) const override
    {
        return occluded(pixels, {});
    }

    [[nodiscard]] std::vector<std::uint8_t>
    are_self_shadowing(std::span<const renderers::SelfShadowingQuery> queries) const override
    {
        return answer<std::uint8_t>(queries, [&](const renderers::SelfShadowingQuery& q) {
            return own.contains({q.pixel, q.triangle});
        });
    }

    [[nodiscard]] std::vector<renderers::BlockerHit>
    find_blockers(std::span<const std::size_t> pixels, scene::Cull cull) const override
    {
        const auto& known = cull == scene::Cull::none ? blockers : blockers_left;
        return answer<renderers::BlockerHit>(pixels, [&](std::size_t p) { return known.at(p); });
    }

private:
    template <typename Answer, typename Queries, typename Find>
    static std::vector<Answer> answer(const Queries& queries, const Find& find)
    {
        std::vector<Answer> answers;
        for (const auto& query : queries) {
            answers.push_back(static_cast<Answer>(find(query)));
        }
        return answers;
    }

    [[nodiscard]] renderers::TexelHit hit(const scene::Texel& texel) const
    {
        const auto found = hits.find({texel.x, texel.y});
        return found == hits.end() ? renderers::TexelHit{} : found->second;
    }
    [[nodiscard]] double receiver(std::size_t pixel, const renderers::ReceiverRule& rule) const
    {
        const double nearer = rule.moved == nullptr ? 0 : double{(*rule.moved)[pixel].w};
        const double depth = pixel_depths.at(pixel) - nearer;
        return rule.clamps ? std::clamp(depth, 0.0, 1.0) : depth;
    }
    [[nodiscard]] double depth(const renderers::ExactTap& tap) const
    {
        return tap.shift + (tap.triangle == scene::no_triangle ? tap.depth : hit(tap.texel).depth);
    }
};

} // namespace gnomon::analysis
