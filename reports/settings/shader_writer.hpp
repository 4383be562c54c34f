#pragma once

#include "reports/tune/shader_lines.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// Writes shader code that reads a light's maps, line by line, in one of two languages.
///
/// Lines are given in GLSL. HLSL takes them with its own names of types and functions, so they may
/// use only what both languages have. The matrix is `light_clip_from_world`, the texture
/// `shadow_map`; with several maps `cascade` is an index into both.
class ShaderWriter {
public:
    /// @param maps  of the light; at least 1.
    ShaderWriter(ShaderLanguage language, std::size_t maps) : language_{language}, maps_{maps} {}

    void add(std::string_view line);

    [[nodiscard]] bool is_hlsl() const { return language_ == ShaderLanguage::hlsl; }
    [[nodiscard]] ShaderLanguage language() const { return language_; }
    [[nodiscard]] bool has_cascades() const { return maps_ > 1; }
    /// "[4]" behind the name of what each map has; empty for one map.
    [[nodiscard]] std::string count() const;
    [[nodiscard]] std::string_view parameter() const
    {
        return has_cascades() ? ", int cascade" : "";
    }
    [[nodiscard]] std::string_view argument() const { return has_cascades() ? ", cascade" : ""; }

    /// A world point in the clip space of the map.
    [[nodiscard]] std::string clip_of(std::string_view point) const;
    /// The first three numbers of a row of the matrix.
    [[nodiscard]] std::string row(std::size_t i) const;
    /// The depth of the texel that holds `tap`.
    [[nodiscard]] std::string texel_at_tap() const;

    /// Declares an array of numbers.
    void add_array(std::string_view name, const std::vector<float>& values);
    /// A number for each map: itself where all maps share it, else an element of an array that
    /// this declares.
    [[nodiscard]] std::string by_map(std::string_view name, const std::vector<float>& values);

    [[nodiscard]] std::vector<std::string> take_lines();

private:
    [[nodiscard]] std::string_view matrix() const
    {
        return has_cascades() ? "light_clip_from_world[cascade]" : "light_clip_from_world";
    }

    ShaderLanguage language_;
    std::size_t maps_;
    std::vector<std::string> lines_;
};

/// Adds `vec2 plane_rise(vec3 position, vec3 N)`: the change of depth from texel to texel along the
/// receiver's plane.
/// @param resolution   texels of the map's side, as a number of the shader.
/// @param is_reversed  whether near is at depth 1.
void add_plane_rise(ShaderWriter& out, std::string_view resolution, bool is_reversed);

/// Adds `vec2 derived_rise(vec3 position)`: the same by the neighbouring pixels.
void add_derived_rise(ShaderWriter& out, std::string_view resolution, bool is_reversed);

/// Adds `float tap_visibility(vec2 tap, float depth)`: compares with the texel that holds `tap`.
/// @param outside  what a tap beyond the map answers.
void add_tap_visibility(ShaderWriter& out, int resolution_texels, scene::Outside outside,
                        bool is_reversed);

} // namespace gnomon::reports
