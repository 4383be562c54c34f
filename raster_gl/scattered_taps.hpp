#pragma once

#include "methods/lookup_traits.hpp"
#include "raster_gl/program.hpp"
#include "scene/view/view.hpp"

#include <string>

namespace gnomon::raster_gl {

/// Source of where the taps of a kernel lie (shaders/scattered_taps.glsl); nothing where they are a
/// square of texels.
[[nodiscard]] std::string tap_places(const methods::ScatteredTaps& taps);

/// What that source, and what includes it, is compiled with.
void add_definitions(const methods::ScatteredTaps& taps, Definitions& definitions);

/// Hands a program places, radius and rotations, which are the CPU's own tables; nothing where the
/// taps are a square of texels.
/// @param resolution_texels  of each of the view's maps.
void set_uniforms(const Program& lookup, const methods::ScatteredTaps& taps,
                  const scene::View& view, int resolution_texels);

} // namespace gnomon::raster_gl
