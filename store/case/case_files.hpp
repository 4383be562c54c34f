#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// Reads the channels of a case's image, and its shadow map if it names one.
///
/// The files may be hostile: headers are checked before anything is decoded or allocated.
/// @param memory_bytes  memory limit; 0: unknown, no limit.
/// @throws scene::InputError  in one line with fault, channel, pixel and remedy: a file or channel
///                            is missing, truncated, too large, of the wrong type or in several
///                            parts; the mask is NaN or outside [0, 1]; a position is not finite
///                            although `valid` is set; or no pixel is valid.
[[nodiscard]] scene::CaseLayers read_case_layers(const scene::CaseFile& file,
                                                 std::uint64_t memory_bytes);

/// Content of a case that its comparison does not hold.
struct CaseExtras {
    scene::Image<scene::Vec3f> points; ///< P of each pixel [m], NaN where there is no receiver
    scene::CameraSettings camera;      ///< of the comparison's view, even if the job has none
    scene::LightSettings light;
    scene::LookupLayers unmoved;    ///< the lookup without any bias; empty if it can be derived
    scene::Image<float> map_depths; ///< as shaders see them; empty for `nearest`
};

/// The files that a case may have, case.toml first.
[[nodiscard]] std::span<const std::string_view> case_files();

/// Writes GL's verdict as a case of another renderer (docs/evaluate.md): case.toml, aov.exr,
/// mesh.glb and, if there are depths, map.exr.
/// @param folder  created if missing.
/// @throws std::invalid_argument    if images differ in size.
/// @throws scene::EnvironmentError  if a file cannot be written.
void write_case(const std::filesystem::path& folder, const analysis::Comparison& comparison,
                const CaseExtras& extras);

/// Encodes a scene as binary glTF without loss: triangles, their order, object names and normals
/// read back bit by bit.
/// @throws scene::InputError  if the scene takes more than the format's 4 GiB.
[[nodiscard]] std::vector<std::byte> encode_glb(const scene::TriangleScene& scene);

} // namespace gnomon::store
