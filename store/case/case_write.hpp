#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <filesystem>
#include <span>
#include <string_view>

namespace gnomon::store {

/// What a case says beside what its comparison does.
struct CaseExtras {
    scene::Image<scene::Vec3f> points; ///< P of each pixel [m], NaN where there is no receiver
    scene::CameraSettings camera;      ///< of the comparison's view, also where its job has none
    scene::LightSettings light;
    scene::LookupLayers unmoved;    ///< the lookup without any bias; empty: it can be derived
    scene::Image<float> map_depths; ///< as shaders see them; empty for `nearest`
};

/// The files that a case may have, the one that names the others first.
[[nodiscard]] std::span<const std::string_view> case_files();

/// Writes GL's verdict as another renderer's case into a folder, which is made where there is none:
/// case.toml, aov.exr, mesh.glb and, if there are depths, map.exr (docs/evaluate.md).
/// @throws std::invalid_argument    if images differ in size.
/// @throws scene::EnvironmentError  if it cannot be written.
void write_case(const std::filesystem::path& folder, const analysis::Comparison& comparison,
                const CaseExtras& extras);

} // namespace gnomon::store
