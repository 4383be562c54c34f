#pragma once

#include "methods/lookup_traits.hpp"
#include "methods/passes.hpp"
#include "methods/polygon_offset.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::methods {

/// Where a bias term acts.
enum class BiasPlace : std::uint8_t {
    map_drawn,       ///< the depths that are drawn into the map
    receiver_depth,  ///< the receiver's depth, before it is compared
    lookup_position, ///< the point that is looked up
    per_tap,         ///< the depth that each tap is compared with
};

/// A bias term: a way to prevent self-shadowing.
///
/// A term is defined in a header of methods/depth/terms and listed by methods (`bias_terms`). Its
/// GLSL snippet defines one function, named `function`; raster_gl/shaders/lookup_map.glsl has
/// `Receiver` and everything else that it may read. Place and stage determine the signature:
///
///     receiver_depth, bias     float NAME(Receiver receiver)
///         what is added to the bias; the first of a list is the one that the curve varies
///     receiver_depth, lookup   float NAME(Receiver receiver, float r)
///         the receiver's depth in place of r
///     lookup_position, lookup  vec3 NAME(Receiver receiver)
///         by how much the point that is looked up is moved in the world [m]
///     per_tap, lookup          vec2 NAME(Receiver receiver)
///         what a tap's reference depth changes by per texel from the point that is looked up
///
/// A term of `map_drawn`, of the stage shadow map, has an `offset` instead of GLSL. Terms of the
/// stage bias are b and slope of the bias curve's formula. All other terms change the map or the
/// lookup position and depth, which the formula takes as given.
struct BiasTerm {
    std::string_view name;
    std::span<const std::string_view> keys; ///< of a job, that set it: one, or one in place of
                                            ///< another; their rows have units and stages
    BiasPlace place = BiasPlace::receiver_depth;
    std::string_view sentence; ///< with its formula
    std::string_view function = {};
    /// The GLSL with the values of its uniforms; empty if the term does not act. Numbers come from
    /// `view.bias`, where they are missing or neutral for an unbiased lookup.
    std::optional<GlslSnippet> (*snippet)(const scene::Job& job, const scene::View& view) = nullptr;
    /// Keys that the layer `scene` does not define; nullptr if it defines all.
    std::vector<scene::Key> (*own_keys)() = nullptr;
    /// For `map_drawn`: the polygon offset of the map; empty if the term does not act.
    std::optional<PolygonOffset> (*offset)(const scene::View& view) = nullptr;
    /// Throws `scene::InputError` for a job in which the term cannot act; nullptr if it always can.
    /// @param promised  traits of the job's method.
    void (*check)(const scene::Job& job, const LookupTraits& promised) = nullptr;
    /// For `lookup_position`: distance along the normal by which it moves the lookup of a receiver
    /// at ζ in a map [m]; nullptr if it moves lookups in another way.
    double (*length_m)(const scene::Job& job, const scene::View& view, std::size_t map,
                       double light_distance_m) = nullptr;
    /// Whether its snippet reads vertex normals, which the scene must then keep; nullptr: never.
    bool (*reads_vertex_normals)(const scene::Job& job) = nullptr;
};

/// The term's keys in the key table.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] std::vector<scene::Key> keys_of(const BiasTerm& term);

/// The stages to redo when the term changes: those of its keys.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] scene::Stages stages_of(const BiasTerm& term);

/// Whether it is part of the bias curve's formula: constant and slope.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] bool is_of_curve(const BiasTerm& term);

/// @throws std::invalid_argument  if the term is incomplete or inconsistent.
void check(const BiasTerm& term);

/// The terms of a method.
/// @throws std::invalid_argument  for one of them; if the first of the bias curve's, which the
/// curve
///                                varies, is not the constant bias.
void check(std::span<const BiasTerm> terms);

/// A bias term that acts on a job.
struct ActiveBias {
    const BiasTerm* term = nullptr;
    GlslSnippet snippet;
};

/// The job's number for a term's own key; 0 if its method has no such key.
/// @throws std::invalid_argument  if it is not a number.
[[nodiscard]] double number_in(const scene::Job& job, std::string_view key);

/// The terms that act on a job's lookups, in order.
[[nodiscard]] std::vector<ActiveBias> active_biases(std::span<const BiasTerm> terms,
                                                    const scene::Job& job, const scene::View& view);

/// Whether a term acts that is not part of the bias curve's formula.
[[nodiscard]] bool moves_lookups(std::span<const ActiveBias> biases);

/// The place's name in results and documents: "receiver_depth".
[[nodiscard]] std::string_view name(BiasPlace place);

} // namespace gnomon::methods
