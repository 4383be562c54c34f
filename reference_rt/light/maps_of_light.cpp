#include "reference_rt/light/maps_of_light.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

namespace gnomon::reference_rt {

using renderers::BlockerHit;
using renderers::HitDetail;
using renderers::KnownHits;
using renderers::LightQueries;
using renderers::LinearQuery;
using renderers::NearestQuery;
using renderers::ReceiverRule;
using renderers::SelfShadowingQuery;
using renderers::TexelHit;
using scene::MapIndices;
using scene::Texel;

namespace {

/// Selects the map that answers a query.
struct MapSelector {
    int operator()(const Texel& texel) const { return texel.map; }
    int operator()(const NearestQuery& query) const { return query.map; }
    int operator()(const LinearQuery& query) const { return query.first.map; }
    int operator()(const SelfShadowingQuery& query) const { return query.texel.map; }
};

class ShadowMapRays final : public LightQueries {
public:
    explicit ShadowMapRays(std::vector<std::unique_ptr<LightQueries>> maps) : maps_{std::move(maps)}
    {
    }

    std::vector<TexelHit> first_hits(std::span<const Texel> texels, HitDetail detail) const override
    {
        return ask_each<TexelHit>(texels, MapSelector{},
                                  [&](std::size_t map, const Part<Texel>& part) {
                                      return maps_[map]->first_hits(part.questions, detail);
                                  });
    }

    std::vector<TexelHit> first_hits(std::span<const Texel> texels,
                                     const KnownHits& known) const override
    {
        if (known.triangles.size() != texels.size() || known.maps.size() != maps_.size()) {
            throw std::invalid_argument{"first_hits: known: not of these texels"};
        }
        return ask_each<TexelHit>(
            texels, MapSelector{}, [&](std::size_t map, const Part<Texel>& part) {
                std::vector<std::uint32_t> triangles;
                triangles.reserve(part.places.size());
                for (const std::size_t place : part.places) {
                    triangles.push_back(known.triangles[place]);
                }
                return maps_[map]->first_hits(part.questions,
                                              KnownHits{known.maps.subspan(map, 1), triangles});
            });
    }

    std::vector<float> receiver_depths(std::span<const std::size_t> pixels, const MapIndices& maps,
                                       const scene::Image<scene::Vec4f>* moved) const override
    {
        return ask_each<float>(
            pixels, [&](std::size_t pixel) { return scene::map_of(maps, pixel); },
            [&](std::size_t map, const Part<std::size_t>& part) {
                return maps_[map]->receiver_depths(part.questions, maps, moved);
            });
    }

    std::vector<scene::Vec2f> map_places(std::span<const std::size_t> pixels,
                                         const MapIndices& maps,
                                         const scene::Image<scene::Vec4f>* moved) const override
    {
        return ask_each<scene::Vec2f>(
            pixels, [&](std::size_t pixel) { return scene::map_of(maps, pixel); },
            [&](std::size_t map, const Part<std::size_t>& part) {
                return maps_[map]->map_places(part.questions, maps, moved);
            });
    }
    double place_error_texels() const override
    {
        double largest = 0;
        for (const auto& map : maps_) {
            largest = std::max(largest, map->place_error_texels());
        }
        return largest;
    }

    std::vector<float> texel_depths(std::span<const Texel> texels,
                                    const scene::Vec2d& place) const override
    {
        return ask_each<float>(texels, MapSelector{},
                               [&](std::size_t map, const Part<Texel>& part) {
                                   return maps_[map]->texel_depths(part.questions, place);
                               });
    }

    std::vector<float> second_depths(std::span<const Texel> texels) const override
    {
        return ask_each<float>(texels, MapSelector{},
                               [&](std::size_t map, const Part<Texel>& part) {
                                   return maps_[map]->second_depths(part.questions);
                               });
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
                                       const MapIndices& maps) const override
    {
        return ask_each<std::uint8_t>(
            pixels, [&](std::size_t pixel) { return scene::map_of(maps, pixel); },
            [&](std::size_t map, const Part<std::size_t>& part) {
                return maps_[map]->occluded(part.questions, maps);
            });
    }

    std::vector<std::uint8_t> occluded_anywhere(std::span<const std::size_t> pixels,
                                                scene::Cull cull) const override
    {
        return maps_.front()->occluded_anywhere(pixels, cull);
    }

    std::vector<std::uint8_t>
    are_self_shadowing(std::span<const SelfShadowingQuery> queries) const override
    {
        return ask_each<std::uint8_t>(queries, MapSelector{},
                                      [&](std::size_t map, const Part<SelfShadowingQuery>& part) {
                                          return maps_[map]->are_self_shadowing(part.questions);
                                      });
    }

    std::vector<BlockerHit> find_blockers(std::span<const std::size_t> pixels,
                                          scene::Cull cull) const override
    {
        return maps_.front()->find_blockers(pixels, cull);
    }

private:
    /// The queries to one map, in order, and their indices among all queries.
    template <typename Question>
    struct Part {
        std::vector<Question> questions;
        std::vector<std::size_t> places;
    };

    /// Sends each map its queries and merges the answers.
    /// @param map_of  the map of a query.
    /// @param ask     answers the queries of one map, in order.
    /// @return  An answer for each query.
    template <typename Answer, typename Question, typename MapOf, typename Ask>
    [[nodiscard]] std::vector<Answer> ask_each(std::span<const Question> questions,
                                               const MapOf& map_of, const Ask& ask) const
    {
        std::vector<Part<Question>> parts(maps_.size());
        for (std::size_t i = 0; i < questions.size(); ++i) {
            const auto map = static_cast<std::size_t>(map_of(questions[i]));
            if (map >= maps_.size()) {
                throw std::invalid_argument{fmt::format(
                    "LightQueries: the light has no map {}, but {}", map, maps_.size())};
            }
            parts[map].questions.push_back(questions[i]);
            parts[map].places.push_back(i);
        }
        std::vector<Answer> answers(questions.size());
        for (std::size_t map = 0; map < parts.size(); ++map) {
            const std::vector<Answer> found = ask(map, parts[map]);
            for (std::size_t i = 0; i < found.size(); ++i) {
                answers[parts[map].places[i]] = found[i];
            }
        }
        return answers;
    }

    template <typename Query>
    [[nodiscard]] std::vector<float> find_biases(std::span<const Query> queries,
                                                 const ReceiverRule& rule) const
    {
        return ask_each<float>(
            queries, MapSelector{}, [&](std::size_t map, const Part<Query>& part) {
                return maps_[map]->critical_biases(std::span{part.questions}, rule);
            });
    }

    std::vector<std::unique_ptr<LightQueries>> maps_;
};

} // namespace

std::unique_ptr<LightQueries> shadow_map_rays(std::vector<std::unique_ptr<LightQueries>> maps)
{
    if (maps.empty()) {
        throw std::invalid_argument{"light_of_maps: a light without shadow maps"};
    }
    if (maps.size() > scene::most_maps) {
        throw std::invalid_argument{fmt::format("light_of_maps: {} maps; a light has at most {}",
                                                maps.size(), scene::most_maps)};
    }
    if (maps.size() == 1) {
        return std::move(maps.front());
    }
    return std::make_unique<ShadowMapRays>(std::move(maps));
}

} // namespace gnomon::reference_rt
