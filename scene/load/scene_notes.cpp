#include "scene/load/scene_notes.hpp"

#include "scene/geometry/triangles.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::scene {

namespace {

using Notes = std::vector<SceneNote>;

/// "1 material is", "2 materials are".
std::string counted_with_verb(std::uint64_t count, std::string_view noun, std::string_view singular,
                              std::string_view plural)
{
    return fmt::format("{} {}", counted(count, noun), count == 1 ? singular : plural);
}

void note(Notes& notes, std::string_view kind, std::uint64_t count, std::string text)
{
    if (count > 0) {
        notes.push_back({std::string{kind}, count, std::move(text)});
    }
}

void note_camera(Notes& notes, std::uint64_t cameras, const SceneDefaults& defaults)
{
    if (!defaults.camera) {
        note(notes, "unused_cameras", cameras,
             fmt::format("{} of the file cannot be used: the view frames the scene instead; give "
                         "one under [camera]",
                         counted(cameras, "camera")));
        return;
    }
    note(notes, "camera_from_file", 1, "the camera is the file's own");
    if (cameras > 1) {
        note(notes, "unused_cameras", cameras - 1,
             fmt::format("the file's {} left out",
                         counted_with_verb(cameras - 1, "other camera", "is", "are")));
    }
}

void note_light(Notes& notes, std::uint64_t lights, const SceneDefaults& defaults)
{
    if (!defaults.light) {
        note(notes, "unused_lights", lights,
             fmt::format("{} of the file cannot be used (spots of 180 degrees and more have no "
                         "shadow map, and areas are no lights here): the default sun shines "
                         "instead; give a light under [light]",
                         counted(lights, "light")));
        return;
    }
    note(notes, "light_from_file", 1,
         fmt::format("the light is the file's own, {}", light_type_name(defaults.light->type)));
    if (lights > 1) {
        note(notes, "unused_lights", lights - 1,
             fmt::format("the file's {} left out",
                         counted_with_verb(lights - 1, "other light", "is", "are")));
    }
}

void note_alpha(Notes& notes, const ContentCounts& counts)
{
    note(notes, "alpha_mask", counts.masked_materials,
         fmt::format("{} cut out by alpha, but taken as solid: {}",
                     counted_with_verb(counts.masked_materials, "material", "is", "are"),
                     counted(counts.masked_objects, "object")));
    note(notes, "alpha_blend", counts.blended_materials,
         fmt::format("{} transparent, but taken as solid: {}",
                     counted_with_verb(counts.blended_materials, "material", "is", "are"),
                     counted(counts.blended_objects, "object")));
    note(notes, "alpha_zero", counts.clear_materials,
         fmt::format("{} a base alpha of 0, and would not be seen at all, but {} taken as solid",
                     counted_with_verb(counts.clear_materials, "material", "has", "have"),
                     counts.clear_materials == 1 ? "is" : "are"));
    note(notes, "alpha_vertices", counts.vertex_alpha_objects,
         fmt::format("{} vertices with an alpha below 1, but {} taken as solid",
                     counted_with_verb(counts.vertex_alpha_objects, "object", "has", "have"),
                     counts.vertex_alpha_objects == 1 ? "is" : "are"));
}

void note_motion(Notes& notes, const ContentCounts& counts)
{
    note(notes, "skins_at_rest", counts.skinned_objects,
         fmt::format("{} as modelled, not as the skin's joints would pose it: export the pose as a "
                     "mesh",
                     counted_with_verb(counts.skinned_objects, "object", "stands", "stand")));
    note(notes, "morphs_at_rest", counts.morphed_objects,
         fmt::format("{} the base shape, without morph targets: export the shape as a mesh",
                     counted_with_verb(counts.morphed_objects, "object", "has", "have")));
    note(notes, "animations_at_rest", counts.animations,
         fmt::format("{} not played: everything stands where the file's nodes put it",
                     counted_with_verb(counts.animations, "animation", "is", "are")));
}

void note_left_out(Notes& notes, const TriangleScene& scene)
{
    const auto& extensions = scene.file.unread_extensions;
    note(notes, "unread_extensions", extensions.size(),
         fmt::format("{} not read: {}",
                     counted_with_verb(extensions.size(), "extension of the file", "is", "are"),
                     fmt::join(extensions, ", ")));
    const std::uint64_t shapes = scene.file.counts.free_form_shapes;
    note(notes, "free_form_shapes", shapes,
         fmt::format("{} left out: export polygons",
                     counted_with_verb(shapes, "free-form shape", "is", "are")));
    note(notes, "points_and_lines", scene.ignored_primitives,
         fmt::format("points and lines cast no shadow, and {} left out",
                     scene.ignored_primitives == 1
                         ? "one is"
                         : fmt::format("{} are", grouped(scene.ignored_primitives))));
    note(notes, "flat_triangles", scene.dropped_triangles,
         fmt::format("{} left out: no area is left in float32",
                     counted_with_verb(scene.dropped_triangles, "flat triangle", "is", "are")));
}

/// The largest absolute coordinate.
double reach_of(const TriangleScene& scene)
{
    const Box box = scene.bounds();
    const Vec3d reach = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    return std::max({reach.x, reach.y, reach.z});
}

/// Lists objects that lost triangles: `12 triangles of "wall"`.
std::string flat_parts(const TriangleScene& scene)
{
    constexpr std::size_t most_named = 3;
    std::vector<std::string> parts;
    std::size_t objects = 0;
    for (const Object& object : scene.objects) {
        if (object.flat_triangles > 0 && ++objects <= most_named) {
            parts.push_back(fmt::format("{} of \"{}\"", counted(object.flat_triangles, "triangle"),
                                        one_line(object.name)));
        }
    }
    if (objects > most_named) {
        parts.push_back(fmt::format("triangles of {} more", objects - most_named));
    }
    return parts.empty() ? "" : fmt::format(", and no area is left of {}", fmt::join(parts, ", "));
}

/// Far from the origin float32 is coarse beside the scene.
void note_float32(Notes& notes, const TriangleScene& scene)
{
    constexpr double coarse = 0x1p-14; // relative to the scene: 1 in 16,000
    if (scene.triangles.empty()) {
        return;
    }
    const double reach = reach_of(scene);
    const double step = std::ldexp(1.0, std::ilogb(reach) - 23);
    if (step >= coarse * scene.bounds().diagonal_m()) {
        note(notes, "coarse_float32", scene.vertices.size(),
             fmt::format("the scene lies up to {} from its origin, where float32 has steps of "
                         "{:.3g}: coordinates were moved by up to {:.3g}{}; move the scene near "
                         "its origin",
                         grouped(static_cast<std::uint64_t>(reach)), step, step / 2,
                         flat_parts(scene)));
    }
}

} // namespace

LeftToFile left_to_file(const Job& job)
{
    return {!job.camera, !job.light};
}

std::vector<SceneNote> scene_notes(const TriangleScene& scene, const SceneDefaults& defaults,
                                   LeftToFile left)
{
    Notes notes;
    const ContentCounts& counts = scene.file.counts;
    if (left.camera) {
        note_camera(notes, counts.cameras, defaults);
    }
    if (left.light) {
        note_light(notes, counts.lights, defaults);
    }
    note_alpha(notes, counts);
    note_motion(notes, counts);
    note_left_out(notes, scene);
    note_float32(notes, scene);
    return notes;
}

SceneNote enclosed_light_note(const std::string& object)
{
    return {"enclosed_light", 1,
            fmt::format("the light is inside \"{}\", which shadows nearly all that is seen: if it "
                        "is part of the lamp, add it to scene.no_cast",
                        one_line(object))};
}

} // namespace gnomon::scene
