#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace gnomon::store {

/// Writes every layer of a comparison into one EXR file.
///
/// float32: `truth` (1 lit, 0 blocked, −1 not scored), `verdict`, `P.X P.Y P.Z` [m],
/// `receiver_depth`, `map_depth` (NaN where the border mode decided); uint32: `class` (the values
/// of scene::PixelClass), `prim` and `witness` (0xFFFFFFFF for none). The header holds the exact
/// inputs as `gnomon:eye` … in hexadecimal, and the job as JSON in `gnomon:job`.
/// @param points  P of each pixel [m], NaN where there is no receiver.
/// @throws std::invalid_argument    if `points` has another size than the image.
/// @throws scene::EnvironmentError  if the file cannot be written; an existing file stays.
void write_aov(const std::filesystem::path& path, const analysis::Comparison& comparison,
               const scene::Image<scene::Vec3f>& points);

/// As above for a job with several lights, with channels `NAME.truth` and so on.
/// @param lights  at least one; all share the camera, and so P.
void write_aov(const std::filesystem::path& path, std::span<const analysis::Comparison> lights,
               const scene::Image<scene::Vec3f>& points);

/// The truth in a file of `write_aov`.
struct Aov {
    /// The header's texts by name, without the prefix "gnomon:": "eye", "job", ….
    std::map<std::string, std::string> texts;
    scene::Image<scene::PixelClass> pixel_class;
    scene::Image<float> truth;           ///< 1 lit, 0 blocked, −1 not scored
    scene::Image<std::uint32_t> prim;    ///< GL's triangle, or `scene::no_triangle`
    scene::Image<std::uint32_t> witness; ///< a triangle that blocks, or `scene::no_triangle`
    scene::Image<scene::Vec3f> position; ///< P [m], NaN where there is no receiver
};

/// Reads the channels `class`, `truth`, `prim`, `witness` and `P`, and the header's texts.
///
/// The file may be hostile: its header is checked before anything is decoded or allocated.
/// @param image  the required size.
/// @param light  selects the light in a file of several lights; ignored in one with a single light.
/// @throws scene::InputError  in one line, if the file is missing, truncated, not an EXR file of
///                            scanlines, or has another size; if a channel is missing or has
///                            another type; or for a class code above 6.
[[nodiscard]] Aov read_aov(const std::filesystem::path& path, scene::ImageSize image,
                           const std::string& light = {});

/// Writes a comparison's shadow map into an EXR file, with the header of `write_aov`. Several maps
/// become parts with the maps' names.
///
/// float32: `depth` as shaders see it, in [0, 1], and the corresponding `light_distance_m` [m], NaN
/// where nothing was drawn. The distance is measured from the light's camera plane, or from the
/// light if the map stores distances.
/// @param depths  of the view's maps, top left first (`scene::maps_image_size`).
/// @throws std::invalid_argument    if `depths` has another size than the maps.
/// @throws scene::EnvironmentError  if the file cannot be written; an existing file stays.
void write_depth_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                     const scene::Image<float>& depths);

/// The unit normal of the triangle that a pixel shows, on the side that the camera sees; NaN if the
/// case of another renderer does not determine that side. Precondition: the pixel shows a triangle
/// of the scene.
[[nodiscard]] scene::Vec3d facing_normal(const analysis::Comparison& comparison, int x, int y);

/// The unit normal interpolated from the vertices at P, on the side of `facing_normal`.
/// @param point  P [m].
/// Precondition: the pixel shows a triangle of the scene, which has normals.
[[nodiscard]] scene::Vec3d facing_vertex_normal(const analysis::Comparison& comparison, int x,
                                                int y, const scene::Vec3d& point);

} // namespace gnomon::store
