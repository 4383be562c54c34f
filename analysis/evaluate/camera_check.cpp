#include "analysis/evaluate/camera_check.hpp"

#include "analysis/evaluate/mask_check.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Vec3d;
using scene::Vec3f;

/// The truth is sought of no more pixels than this.
constexpr std::size_t most_sampled_pixels = 16384;
constexpr std::uint64_t unseen_of = 50; ///< One pixel of so many may be beside what is seen.

bool is_shown(const Vec3f& point)
{
    return !std::isnan(point.x);
}

/// Which of a mask's rows and columns come in the opposite order.
struct Reversed {
    bool rows = false;
    bool columns = false;
};

/// What a camera sees, in the order of the mask's rows and columns.
Image<Vec3f> points_of_mask(const renderers::RoundedReference& truth, const scene::View& view,
                            const Reversed& reversed)
{
    const Image<Vec3f> seen = truth.seen_points(view);
    const auto [width, height] = seen.size();
    Image<Vec3f> points{seen.size()};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            points(x, y) =
                seen(reversed.columns ? width - 1 - x : x, reversed.rows ? height - 1 - y : y);
        }
    }
    return points;
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

/// How many values the mask has where a camera sees nothing, borders apart. Where the mask says of
/// no pixel that it shows nothing, its more frequent value there is taken for that.
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

/// How a camera suits the mask.
struct CameraFit {
    MaskAgreement agreement;
    std::uint64_t unseen = 0; ///< `count_unseen`
    std::uint64_t asked = 0;  ///< pixels

    [[nodiscard]] bool sees_too_little() const { return unseen * unseen_of > asked; }
    /// Whether most pixels that the mask shadows are lit, as where a view is too wide. Few pixels
    /// are blocked then, and the index alone may look good.
    [[nodiscard]] bool shadows_elsewhere() const
    {
        return agreement.lit - agreement.lit_right > agreement.blocked_right;
    }
    /// The agreement, less the share of the values that are beside what is seen.
    [[nodiscard]] double index() const
    {
        return agreement.index() - static_cast<double>(unseen) / static_cast<double>(asked);
    }
};

/// @param reversed  beside what the case says of its axes.
CameraFit fit_camera(const Case& subject, const CheckedCase& checked,
                     const renderers::RoundedReference& truth, const scene::View& view,
                     const Reversed& reversed)
{
    const scene::CaseLayers& layers = subject.layers;
    const Image<Vec3f> points = points_of_mask(
        truth, view, {reversed.rows, reversed.columns != subject.file.space.is_mirrored()});
    CameraFit fit;
    fit.unseen = count_unseen(layers, points);
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < points.pixel_count(); ++i) {
        fit.asked += layers.is_asked[i];
        if (layers.is_asked[i] != 0 && is_shown(points[i])) {
            pixels.push_back(i);
        }
    }
    const std::size_t count = std::min(pixels.size(), most_sampled_pixels);
    const scene::ImageSize row{static_cast<int>(count), 1};
    const auto eye =
        checked.receivers.eye ? std::optional{view.camera.eye} : std::nullopt; // perspective
    scene::RoundedReceivers receivers{
        Image<Vec3f>{row}, {}, eye, {}, checked.receivers.most_distance_m};
    Image<float> mask{row};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t pixel = pixels[i * pixels.size() / count];
        receivers.position[i] = points[pixel];
        mask[i] = layers.mask[pixel];
    }
    if (count > 0) {
        fit.agreement =
            agreement(mask, truth.find_rounded_truth(view.light, receivers).truth.pixel_class);
    }
    return fit;
}

/// Another picture that the case may mean, and which mistake it is then.
struct OtherPicture {
    scene::Job job;
    ImportMistake mistake;
    Reversed reversed = {};
};

scene::Job with_camera(scene::Job job, const scene::CameraSettings& camera)
{
    job.camera = camera;
    return job;
}

/// The opening or height of what is seen, were it that of another side of the image.
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

/// The mask in another order of its rows and columns.
std::vector<OtherPicture> other_orders(const scene::Job& job)
{
    std::vector<OtherPicture> others;
    for (const auto& [reversed, words] : {std::pair{Reversed{true, false}, "rows are"},
                                          {Reversed{false, true}, "columns are"},
                                          {Reversed{true, true}, "rows and columns are"}}) {
        others.push_back(
            {job,
             {"flipped_image", fmt::format("the mask is flipped against the camera: its {} in the "
                                           "opposite order; an image begins at its top left, and "
                                           "conventions.rows says otherwise",
                                           words)},
             reversed});
    }
    return others;
}

/// Camera and light in a space whose other axis is up: what the case gives belongs to it, were
/// `conventions.up` forgotten, or set where it should not be.
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
    if (turned.camera->up != space.up_of_mesh()) { // which is up whatever the axes
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

/// As far better as the renderer's own errors could not make another camera's picture: nearly right
/// everywhere, and with less than a third of what the given camera leaves unexplained.
bool explains_far_better(const CameraFit& other, const CameraFit& given)
{
    return other.agreement.has_both() && other.index() >= 0.8 &&
           1 - other.index() <= 0.3 * (1 - given.index()) &&
           2 * (other.agreement.lit_right + other.agreement.blocked_right) >
               given.agreement.lit + given.agreement.blocked;
}

} // namespace

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
        const CameraFit fit =
            fit_camera(subject, checked, truth, scene::resolve_view(other.job, subject.mesh, {}),
                       other.reversed);
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
