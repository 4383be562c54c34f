#pragma once

#include "scene/light/depth_range.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gnomon::scene {

/// What a map stores of the surface that the light sees first.
enum class MapContent : std::uint8_t { depth, distance, linear };

/// What of a point is stored.
enum class Measure : std::uint8_t {
    clip_depth, ///< z/w by the map's matrix: GL's own depth, of any light, reversed or not
    axis,       ///< ζ, the distance from the plane of the light's camera: w
    ray,        ///< ρ, the distance to the light
};

/// What holds of a content. GL writes depth itself. A shader writes the others, of a light with a
/// position:
///
///     (m − o) / (far − o)        m: the measure, o: near or 0
struct MapContentTraits {
    MapContent content;
    std::string_view name;           ///< in jobs
    std::string_view meaning;        ///< in the description of the key
    std::string_view noun;           ///< in sentences
    std::string_view why_positional; ///< what a directional light lacks, or has already
    std::string_view shader_line;    ///< what the shader writes
    Measure measure;
    bool from_near; ///< whether o is near

    [[nodiscard]] bool is_gl_depth() const { return measure == Measure::clip_depth; }
    /// Whether it is the root of a sum of squares, of which no mean is decided exactly.
    [[nodiscard]] bool is_root() const { return measure == Measure::ray; }
    /// How what is stored follows from the measure: evenly, and never a z_ndc, but for GL's depth.
    /// @param drawn  how GL's depth follows from ζ
    [[nodiscard]] DepthRange stored_range(const DepthRange& drawn) const;
};

/// All of them, by their enumerators.
[[nodiscard]] std::span<const MapContentTraits> map_contents();
[[nodiscard]] const MapContentTraits& traits_of(MapContent content);

[[nodiscard]] std::string_view map_content_name(MapContent content);
/// Empty if the text names no content.
[[nodiscard]] std::optional<MapContent> map_content_from_name(std::string_view name);

} // namespace gnomon::scene
