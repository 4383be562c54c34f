#include "api/mask.hpp"

#include "methods/key_table.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/error.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace gnomon::api {
namespace {

using scene::Image;
using scene::InputError;
using scene::Vec3f;

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// Rejects keys of the scene and the image, which the mask already sets.
void require_own_keys(const Mask& mask)
{
    for (const scene::Override& key : mask.keys) {
        if (key.key.starts_with("scene.") || key.key.starts_with("image.")) {
            throw InputError(
                fmt::format("{}: the mask already sets scene and size; omit the key", key.key));
        }
    }
}

void require_eye(const scene::Vec3d& eye)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(eye[axis]) <= scene::max_coordinate_m)) {
            throw InputError(fmt::format("eye: {} is {}: coordinates must be finite and within "
                                         "±1e15",
                                         "xyz"[axis], eye[axis]));
        }
    }
}

scene::CaseFile case_of(const Mask& mask)
{
    scene::CaseFile file;
    file.name = "mask";
    file.renderer = "another renderer";
    file.images = {{"mask", "mask", {}, 0}};
    file.conventions.has_fractions = mask.has_fractions;
    if (mask.eye) {
        file.eye = scene::rounded_to_float32(*mask.eye);
    }
    file.source.keys = methods::key_table();
    file.source.name = "evaluate";
    std::vector<scene::Override> keys = mask.keys;
    keys.push_back({"scene.file", "mesh", {}}); // a job needs a scene; this one is in memory
    file.source.file = scene::layer_from_overrides(*file.source.keys, keys);
    return file;
}

template <typename Pixel>
void require_size(const Image<Pixel>& image, scene::ImageSize size, std::string_view name)
{
    if (!image.empty() && image.size() != size) {
        throw InputError(fmt::format("{} has {}x{} pixels, the mask {}x{}: sizes must agree", name,
                                     image.size().width_px, image.size().height_px, size.width_px,
                                     size.height_px));
    }
}

bool is_finite(const Vec3f& point)
{
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// Marks pixels that are not scored, and requires all other values to be in [0, 1].
void validate_layers(scene::CaseLayers& layers)
{
    std::size_t judged = 0;
    for (std::size_t i = 0; i < layers.mask.pixel_count(); ++i) {
        float& value = layers.mask[i];
        if (!is_finite(layers.position[i]) || (!layers.has_positions && std::isnan(value))) {
            layers.position[i] = Vec3f{nothing};
            value = 0;
            continue;
        }
        if (!(value >= 0 && value <= 1)) {
            const auto width = static_cast<std::size_t>(layers.size().width_px);
            throw InputError(fmt::format(
                "mask[{}, {}] is {}: a mask is 1 where lit, 0 where shadowed, and between for "
                "filtered lookups; give NaN positions for pixels that are not scored",
                i / width, i % width, value));
        }
        ++judged;
    }
    if (judged == 0) {
        throw InputError("mask: no pixel can be scored: no position is finite");
    }
}

scene::CaseLayers layers_of(Mask mask)
{
    scene::CaseLayers layers;
    const scene::ImageSize size = mask.values.size();
    require_size(mask.positions, size, "positions");
    require_size(mask.normals, size, "normals");
    layers.mask = std::move(mask.values);
    layers.has_positions = !mask.positions.empty();
    layers.position =
        layers.has_positions ? std::move(mask.positions) : Image<Vec3f>{size, Vec3f{0}};
    layers.normal = std::move(mask.normals);
    validate_layers(layers);
    return layers;
}

} // namespace

EvaluatedMask evaluate(const Scene& scene, Mask mask, int threads)
{
    require_own_keys(mask);
    if (mask.eye) {
        require_eye(*mask.eye);
    }
    const scene::CaseFile file = case_of(mask);
    const std::optional<double> tolerance_m = mask.tolerance_m;
    if (mask.positions.empty() && !file.says("camera.target")) {
        throw InputError("a mask without positions needs the whole camera: give camera.eye, "
                         "camera.target and camera.vertical_fov_deg, or positions");
    }
    scene::CaseLayers layers = layers_of(std::move(mask));
    auto mesh = std::make_unique<const CaseMesh>(scene.triangles(), file.space, threads);
    const LoadedCase loaded{file, std::move(layers), *mesh};
    analysis::CheckedCase checked = loaded.check(tolerance_m);
    if (!checked.check.mistake.empty()) {
        throw InputError(checked.check.sentence);
    }
    analysis::Comparison comparison = loaded.evaluate(std::move(checked));
    return {std::move(mesh), std::move(comparison)};
}

} // namespace gnomon::api
