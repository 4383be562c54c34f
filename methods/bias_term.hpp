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

/// A part of what keeps a surface from shadowing itself.
///
/// A file of its own holds all of it, and the list of a method names it
/// (methods/depth/bias_terms.cpp). Its piece of GLSL defines one function, named `function`;
/// `Receiver` and what else it may read are in raster_gl/shaders/lookup_map.glsl. Place and stage
/// say which:
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
/// A term of `map_drawn`, of the stage shadow map, has no GLSL but an `offset`. Terms of the stage
/// bias are the formula's b and slope, which the bias curve knows; the others make a lookup that is
/// not at the receiver itself, or in another map, whose depths and place every formula takes as
/// they come.
struct BiasTerm {
    std::string_view name;
    std::span<const std::string_view> keys; ///< of a job, that set it: one, or one in place of
                                            ///< another; their rows have units and stages
    BiasPlace place = BiasPlace::receiver_depth;
    std::string_view sentence; ///< with its formula
    std::string_view function = {};
    /// The GLSL, with the values of its uniforms; nothing where the term does not act. Numbers come
    /// from `view.bias`, in which those of an unbiased lookup are missing or neutral.
    std::optional<GlslSnippet> (*snippet)(const scene::Job& job, const scene::View& view) = nullptr;
    /// Rows of those keys that the scene has none of; nullptr: it has all.
    std::vector<scene::Key> (*own_keys)() = nullptr;
    /// Of `map_drawn`: what the map is drawn with; nothing where the term does not act.
    std::optional<PolygonOffset> (*offset)(const scene::View& view) = nullptr;
    /// Refuses a job in which it cannot act, by `scene::InputError`; nullptr: there is none.
    /// @param promised  by the job's method.
    void (*check)(const scene::Job& job, const LookupTraits& promised) = nullptr;
    /// Of `lookup_position`: how far along the normal it moves the lookup of a receiver at ζ in one
    /// of the maps [m]; nullptr: it moves it otherwise.
    double (*length_m)(const scene::Job& job, const scene::View& view, std::size_t map,
                       double light_distance_m) = nullptr;
    /// Whether its piece reads normals of vertices, which a scene is then loaded with; nullptr:
    /// never.
    bool (*reads_vertex_normals)(const scene::Job& job) = nullptr;
};

/// The rows of its keys in the key table.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] std::vector<scene::Key> keys_of(const BiasTerm& term);

/// The stages of a sweep that must be redone when it changes: those of its keys.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] scene::Stages stages_of(const BiasTerm& term);

/// Whether the formula of the bias curve has it: constant and slope.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] bool is_of_curve(const BiasTerm& term);

/// @throws std::invalid_argument  if no lookup does what the term says, or it does not say enough.
void check(const BiasTerm& term);

/// The terms of a method.
/// @throws std::invalid_argument  for one of them; if the first of the bias curve's, which the
/// curve
///                                varies, is not the constant bias.
void check(std::span<const BiasTerm> terms);

/// A bias term at work.
struct ActiveBias {
    const BiasTerm* term = nullptr;
    GlslSnippet snippet;
};

/// What a job has one of the terms' own keys at; 0 where its method has no such key.
/// @throws std::invalid_argument  if it is no number.
[[nodiscard]] double number_in(const scene::Job& job, std::string_view key);

/// Those of the terms that act on a job's lookups, in their order.
[[nodiscard]] std::vector<ActiveBias> active_biases(std::span<const BiasTerm> terms,
                                                    const scene::Job& job, const scene::View& view);

/// Whether one acts that the bias curve does not know.
[[nodiscard]] bool moves_lookups(std::span<const ActiveBias> biases);

/// The place as results and documents spell it: "receiver_depth".
[[nodiscard]] std::string_view name(BiasPlace place);

} // namespace gnomon::methods
