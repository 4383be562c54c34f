#include "analysis/evaluate/case_checks.hpp"

#include "analysis/evaluate/likely_mistakes.hpp"
#include "scene/camera/camera.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Vec3d;
using scene::Vec3f;

/// The camera may see nothing at one in so many pixels of the mask.
constexpr std::uint64_t unseen_of = 50;

bool is_shown(const Vec3f& point)
{
    return !std::isnan(point.x);
}

bool any_neighbour_shown(const Image<Vec3f>& points, int x, int y)
{
    const auto [width, height] = points.size();
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column) {
            if (is_shown(points(column, row))) {
                return true;
            }
        }
    }
    return false;
}

/// How many values the mask has where the camera sees nothing, borders apart. If the mask marks no
/// pixel as empty, the more frequent value there is taken for empty.
std::uint64_t count_unseen(const scene::CaseLayers& layers, const Image<Vec3f>& points)
{
    const auto [width, height] = points.size();
    std::array<std::uint64_t, 2> values{};
    bool asks_everywhere = true;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool is_asked = layers.is_asked(x, y) != 0;
            asks_everywhere = asks_everywhere && is_asked;
            if (is_asked && !any_neighbour_shown(points, x, y)) {
                ++values.at(scene::is_lit(layers.mask(x, y)) ? 1 : 0);
            }
        }
    }
    return asks_everywhere ? std::min(values[0], values[1]) : values[0] + values[1];
}

/// How well a camera suits the mask.
struct CameraFit {
    MaskAgreement agreement;
    std::uint64_t unseen = 0; ///< `count_unseen`
    std::uint64_t asked = 0;  ///< pixels

    [[nodiscard]] bool sees_too_little() const { return unseen * unseen_of > asked; }
    /// Whether most pixels that the mask shadows are lit, as when a view is too wide: few pixels
    /// are blocked then, so the index alone may look good.
    [[nodiscard]] bool shadows_elsewhere() const
    {
        return agreement.lit - agreement.lit_right > agreement.blocked_right;
    }
    /// The agreement minus the share of values where the camera sees nothing.
    [[nodiscard]] double index() const
    {
        return agreement.index() - static_cast<double>(unseen) / static_cast<double>(asked);
    }
};

/// @param flip  In addition to the case's own mirrored axes.
CameraFit fit_camera(const Case& subject, const CheckedCase& checked,
                     const renderers::RoundedReference& truth, const scene::View& view,
                     const Flip& flip)
{
    const scene::CaseLayers& layers = subject.layers;
    const Flip flip_of_mask{flip.rows, flip.columns != subject.file.space.is_mirrored()};
    const Image<Vec3f> points = flip_of_mask.flipped(truth.seen_points(view));
    CameraFit fit;
    fit.unseen = count_unseen(layers, points);
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < points.pixel_count(); ++i) {
        fit.asked += layers.is_asked[i];
        if (layers.is_asked[i] != 0 && is_shown(points[i])) {
            pixels.push_back(i);
        }
    }
    pixels = evenly_spread(pixels);
    const scene::ImageSize row{static_cast<int>(pixels.size()), 1};
    const auto eye =
        checked.receivers.eye ? std::optional{view.camera.eye} : std::nullopt; // perspective
    scene::RoundedReceivers receivers{
        Image<Vec3f>{row}, {}, eye, {}, checked.receivers.most_distance_m};
    Image<float> mask{row};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        receivers.position[i] = points[pixels[i]];
        mask[i] = layers.mask[pixels[i]];
    }
    if (!pixels.empty()) {
        fit.agreement =
            agreement(mask, truth.find_rounded_truth(view.light, receivers).truth.pixel_class);
    }
    return fit;
}

/// Another picture that the case may mean, and the mistake that would explain it.
struct OtherPicture {
    scene::Job job;
    ImportMistake mistake;
    Flip flip = {};
};

scene::Job with_camera(scene::Job job, const scene::CameraSettings& camera)
{
    job.camera = camera;
    return job;
}

/// The opening angle or height taken for that of another side of the image.
std::vector<OtherPicture> other_openings(const scene::Job& job)
{
    const scene::CameraSettings& given = *job.camera;
    const double width = job.image.width_px;
    const double height = job.image.height_px;
    const bool has_eye = given.projection == scene::Projection::perspective;
    std::vector<OtherPicture> others;
    for (const auto& [share, words] :
         {std::pair{height / width, "from left to right"},
          std::pair{height / std::hypot(width, height), "from corner to corner"},
          std::pair{2.0, "of half of the image"}}) {
        if (share == 1 || (has_eye && share == 2 && given.vertical_fov_deg >= 90)) {
            continue;
        }
        scene::CameraSettings camera = given;
        if (!has_eye) {
            camera.orthographic_height_m = share * given.orthographic_height_m;
        } else if (share == 2) {
            camera.vertical_fov_deg = 2 * given.vertical_fov_deg;
        } else {
            camera.vertical_fov_deg =
                2 *
                glm::degrees(std::atan(share * std::tan(glm::radians(given.vertical_fov_deg / 2))));
        }
        const std::string key = has_eye ? "camera.vertical_fov_deg" : "camera.orthographic_height";
        others.push_back(
            {with_camera(job, camera),
             {"field_of_view",
              fmt::format("{0} = {1:.5g} is the size {2}, and not that of the image from top to "
                          "bottom: the mask fits {0} = {3:.6g}; set that",
                          key, has_eye ? given.vertical_fov_deg : given.orthographic_height_m,
                          words,
                          has_eye ? camera.vertical_fov_deg : camera.orthographic_height_m)}});
    }
    return others;
}

std::vector<OtherPicture> other_ups(const scene::Job& job)
{
    const scene::CameraSettings& given = *job.camera;
    constexpr double least_sine = 1e-3; // of the angle between up and the view
    const Vec3d forward = glm::normalize(given.target - given.eye);
    std::vector<OtherPicture> others;
    for (const Vec3d& up : {Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{0, -1, 0},
                            Vec3d{0, 0, -1}, Vec3d{-1, 0, 0}}) {
        if (glm::length(glm::cross(up, forward)) < least_sine ||
            glm::dot(up, glm::normalize(given.up)) > 1 - least_sine) {
            continue;
        }
        scene::CameraSettings camera = given;
        camera.up = up;
        others.push_back({with_camera(job, camera),
                          {"camera_up", fmt::format("the mask fits a camera with another side up: "
                                                    "set camera.up = [{}, {}, {}]",
                                                    up.x, up.y, up.z)}});
    }
    return others;
}

/// The mask with its rows or columns in the opposite order.
std::vector<OtherPicture> other_orders(const scene::Job& job)
{
    std::vector<OtherPicture> others;
    for (const Flip& flip : all_flips) {
        others.push_back(
            {job,
             {"flipped_image", fmt::format("the mask is flipped against the camera: its {} are in "
                                           "the opposite order; an image begins at its top left, "
                                           "and conventions.rows says otherwise",
                                           flip.words())},
             flip});
    }
    return others;
}

/// Camera and light in a space with another up axis, which they fit if `conventions.up` was
/// forgotten or wrongly set.
std::vector<OtherPicture> other_axes(const scene::Job& job, const scene::CaseSpace& space)
{
    const bool is_z_up = space.axes[2].of_mesh == 1;
    if (space.is_mirrored() || (!is_z_up && space.axes[1].of_mesh != 1)) {
        return {};
    }
    const auto turn = [&](Vec3d& v) {
        v = is_z_up ? Vec3d{v.x, -v.z, v.y} : Vec3d{v.x, v.z, -v.y};
    };
    const auto turn_if = [&](std::optional<Vec3d>& v) {
        if (v) {
            turn(*v);
        }
    };
    scene::Job turned = job;
    turn(turned.camera->eye);
    turn(turned.camera->target);
    if (turned.camera->up != space.up_of_mesh()) { // the mesh's up holds for any axes
        turn(turned.camera->up);
    }
    if (turned.light) {
        turn_if(turned.light->direction);
        turn_if(turned.light->position);
        turn_if(turned.light->target);
    }
    return {{turned,
             {"up_axis", fmt::format("camera and light fit a renderer whose {0} is up: set "
                                     "conventions.up = \"{0}\"",
                                     is_z_up ? "y" : "z")}}};
}

/// Better than the renderer's own errors could make another camera's picture: right nearly
/// everywhere, and leaves less than a third of what the given camera leaves unexplained.
bool explains_far_better(const CameraFit& other, const CameraFit& given)
{
    return other.agreement.has_both() && other.index() >= 0.8 &&
           1 - other.index() <= 0.3 * (1 - given.index()) &&
           2 * (other.agreement.lit_right + other.agreement.blocked_right) >
               given.agreement.lit + given.agreement.blocked;
}

/// Distance of P from the ray of a pixel, as a share of its length.
double share_off_ray(const scene::View& view, const Vec3d& point, int x, int y)
{
    const scene::Ray ray = scene::pixel_ray(view.camera, view.image, x, y);
    const Vec3d to_point = point - ray.origin;
    const double length = glm::length(to_point) * glm::length(ray.direction);
    const double across = glm::length(glm::cross(to_point, ray.direction));
    // A ray begins at its origin: no pixel sees what is behind it.
    return glm::dot(to_point, ray.direction) > 0 ? across / length : 2.0;
}

/// The median over some pixels of the flipped image; 0 if none has a position.
double median_off_ray(const scene::View& view, const scene::CaseLayers& layers, const Flip& flip)
{
    const auto [width, height] = view.image;
    std::vector<double> shares;
    const int step = std::max(
        1, static_cast<int>(std::sqrt(static_cast<double>(view.image.pixel_count()) / 4096)));
    for (int y = 0; y < height; y += step) {
        for (int x = 0; x < width; x += step) {
            if (is_shown(layers.position(x, y))) {
                shares.push_back(share_off_ray(view, Vec3d{layers.position(x, y)},
                                               flip.columns ? width - 1 - x : x,
                                               flip.rows ? height - 1 - y : y));
            }
        }
    }
    if (shares.empty()) {
        return 0;
    }
    return nth_smallest(shares, shares.size() / 2);
}

} // namespace

std::optional<ImportMistake> check_camera(const scene::View& view, const scene::CaseLayers& layers)
{
    // Half a pixel's opening angle; any flip of more than a few rows exceeds it by far.
    const double pixel = view.camera.half_height / view.image.height_px;
    if (view.camera.projection != scene::Projection::perspective ||
        median_off_ray(view, layers, {}) <= 2 * pixel) {
        return std::nullopt;
    }
    for (const Flip& flip : all_flips) {
        if (median_off_ray(view, layers, flip) <= 2 * pixel) {
            return ImportMistake{"flipped_image",
                                 fmt::format("the image is flipped against the camera: its {} are "
                                             "in the opposite order; an image begins at its top "
                                             "left",
                                             flip.words())};
        }
    }
    return std::nullopt;
}

std::optional<ImportMistake> check_other_cameras(const Case& subject, const CheckedCase& checked,
                                                 const renderers::RoundedReference& truth)
{
    constexpr double good_agreement = 0.9;
    if (subject.layers.has_positions || !checked.job.camera) {
        return std::nullopt;
    }
    const CameraFit given = fit_camera(subject, checked, truth, checked.view, {});
    if (given.agreement.index() >= good_agreement && !given.sees_too_little() &&
        !given.shadows_elsewhere()) {
        return std::nullopt;
    }
    std::vector<OtherPicture> others = other_openings(checked.job);
    std::ranges::move(other_ups(checked.job), std::back_inserter(others));
    std::ranges::move(other_orders(checked.job), std::back_inserter(others));
    std::ranges::move(other_axes(checked.job, subject.file.space), std::back_inserter(others));
    double best = given.index();
    std::optional<ImportMistake> mistake;
    for (OtherPicture& other : others) {
        const CameraFit fit = fit_camera(
            subject, checked, truth, scene::resolve_view(other.job, subject.mesh, {}), other.flip);
        if (explains_far_better(fit, given) && fit.index() > best + 0.01) {
            best = fit.index();
            mistake = std::move(other.mistake);
        }
    }
    if (!mistake && given.sees_too_little() && given.agreement.index() < good_agreement) {
        return ImportMistake{
            "camera", fmt::format("the mask has values at {} pixels where the camera sees nothing, "
                                  "so the camera is not the renderer's: look at camera.eye, "
                                  "camera.target, camera.up, camera.vertical_fov_deg and the units",
                                  given.unseen)};
    }
    return mistake;
}

} // namespace gnomon::analysis
