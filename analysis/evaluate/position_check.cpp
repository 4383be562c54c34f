#include "analysis/evaluate/case_checks.hpp"

#include "analysis/evaluate/likely_mistakes.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Vec3d;
using scene::Vec3f;

/// Hypotheses are screened on few points; the one that holds is checked on all.
constexpr std::size_t screening_points = 256;
/// Correcting a mistake may lose some accuracy, as dividing by 100 does.
constexpr double slack = 4;

std::vector<Vec3d> checked_points(const scene::Image<Vec3f>& position)
{
    std::vector<Vec3d> points;
    for (const std::size_t pixel : checked_pixels(position)) {
        points.emplace_back(position[pixel]);
    }
    return points;
}

double quantile(std::vector<double>& values, double share)
{
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    return nth_smallest(values, static_cast<std::size_t>(std::max(rank - 1, 0.0)));
}

std::vector<double> distances_of(const renderers::RoundedReference& truth,
                                 std::span<const Vec3d> points)
{
    std::vector<double> distances;
    for (const scene::NearestSurface& surface : truth.nearest_surfaces(points, {})) {
        distances.push_back(surface.distance_m);
    }
    return distances;
}

/// How to correct P if a mistake was made.
struct Hypothesis {
    double factor = 1;
    MixedAxes axes{{{0, 1}, {1, 1}, {2, 1}}};
    Vec3d eye{0.0};
    std::optional<ViewSpace> view_space{}; ///< of P, relative to the eye

    [[nodiscard]] Vec3d corrected(const Vec3d& point) const
    {
        if (view_space) {
            return view_space->turned_back(point) + eye;
        }
        return mixed(axes, point / factor + eye);
    }
};

/// The largest coordinate of the nearest 99 % of the points.
double reach_of(std::span<const Vec3d> points)
{
    std::vector<double> sizes;
    for (const Vec3d& point : points) {
        sizes.push_back(std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}));
    }
    return quantile(sizes, 0.99);
}

/// Tries mistakes on the positions.
class MistakeFinder {
public:
    /// @param tolerance  Of distances, as a share of the largest coordinate.
    MistakeFinder(const renderers::RoundedReference& truth, const std::vector<Vec3d>& points,
                  double mesh_reach, double tolerance)
        : truth_{truth},
          points_{points},
          few_{evenly_spread(points, screening_points)},
          mesh_reach_{mesh_reach},
          tolerance_{slack * tolerance}
    {
    }

    /// The share of the corrected points that are on the mesh; 0 if it is too small.
    ///
    /// The tolerance shrinks with P: else any mistake that shrinks P would pass, by drawing all
    /// points together on a ground through the origin.
    [[nodiscard]] double fit(const Hypothesis& hypothesis) const
    {
        // Few points may miss a share that holds for 99 % of all.
        if (share_near(hypothesis, few_) < 0.96) {
            return 0;
        }
        const double share = share_near(hypothesis, points_);
        return share >= 0.99 ? share : 0;
    }

    /// Prefers one mistake to two; of those that fit alike the likeliest, then the largest P.
    /// @param camera  Null if unknown.
    [[nodiscard]] std::optional<Hypothesis> find(const std::optional<Vec3d>& eye,
                                                 const scene::Camera* camera) const
    {
        if (eye && fit({1, all_axes().front(), *eye}) > 0) {
            return Hypothesis{1, all_axes().front(), *eye};
        }
        if (camera != nullptr) {
            for (const ViewSpace& space : view_spaces(*camera)) {
                const Hypothesis seen{1, all_axes().front(), camera->eye, space};
                if (fit(seen) > 0) {
                    return seen;
                }
            }
        }
        std::vector<Hypothesis> one;
        std::vector<Hypothesis> two;
        for (const UnitMistake& unit : unit_mistakes()) {
            for (const MixedAxes& axes : all_axes()) {
                const bool has_units_only = axes == all_axes().front();
                if (!has_units_only || unit.factor != 1) {
                    (has_units_only ? one : two).push_back({unit.factor, axes});
                }
            }
        }
        const auto found = best_of(one);
        return found ? found : best_of(two);
    }

    /// Whether the points are near the mesh only because they are so much smaller.
    [[nodiscard]] bool may_be_shrunk() const
    {
        return reach_of(points_) * 64 < mesh_reach_ && fit({}) == 0;
    }

private:
    [[nodiscard]] std::optional<Hypothesis> best_of(const std::vector<Hypothesis>& all) const
    {
        constexpr double alike = 5e-4;
        std::optional<Hypothesis> found;
        double best = 0;
        for (const Hypothesis& hypothesis : all) {
            if (const double share = fit(hypothesis); share > best + alike) {
                best = share;
                found = hypothesis;
            }
            if (best >= 1 - alike) { // no other can fit better by more than that
                break;
            }
        }
        return found;
    }

    [[nodiscard]] double share_near(const Hypothesis& hypothesis,
                                    std::span<const Vec3d> points) const
    {
        std::vector<Vec3d> corrected;
        for (const Vec3d& point : points) {
            corrected.push_back(hypothesis.corrected(point));
        }
        const double limit = tolerance_ * std::min(mesh_reach_, reach_of(corrected));
        const auto near = std::ranges::count_if(distances_of(truth_, corrected),
                                                [&](double distance) { return distance <= limit; });
        return static_cast<double>(near) / static_cast<double>(points.size());
    }

    const renderers::RoundedReference& truth_;
    const std::vector<Vec3d>& points_;
    std::vector<Vec3d> few_;
    double mesh_reach_;
    double tolerance_;
};

std::string vector_text(const Vec3d& v)
{
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

std::string unit_text(const Hypothesis& found, const scene::CaseFile& file)
{
    const auto unit = std::ranges::find(unit_mistakes(), found.factor, &UnitMistake::factor);
    if (file.space.units_per_mesh_unit == 1 && file.space.metres_per_unit == 1) {
        return std::string{unit->words};
    }
    return fmt::format("P is {:.6g} times as large as the case's units make the mesh",
                       found.factor);
}

std::string unit_remedy(const Hypothesis& found, const scene::CaseFile& file)
{
    if (found.factor == 1) {
        return {};
    }
    const double metres_per_unit = file.space.metres_per_unit;
    std::string of_renderer =
        fmt::format("conventions.metres_per_unit = {:.8g}", metres_per_unit / found.factor);
    if (found.factor > 1) {
        return of_renderer;
    }
    // The mesh's unit is the smaller one: usually the mesh is not in metres.
    return fmt::format("conventions.mesh_metres_per_unit = {:.8g}, or, if the mesh's is as the "
                       "case says, {}",
                       file.space.units_per_mesh_unit * metres_per_unit * found.factor,
                       of_renderer);
}

ImportMistake mistake_of(const Hypothesis& found, const scene::CaseFile& file)
{
    if (found.view_space) {
        return {"view_space", "P is in view space, relative to the camera and turned with it: "
                              "turned back and with the eye added it lies on the mesh; write "
                              "world positions"};
    }
    if (found.eye != Vec3d{0.0}) {
        return {"camera_relative",
                fmt::format("P is relative to the camera: with the eye {} added it lies on the "
                            "mesh; write world positions",
                            vector_text(found.eye))};
    }
    if (found.axes == all_axes().front()) {
        return {"units",
                fmt::format("{}: set {}", unit_text(found, file), unit_remedy(found, file))};
    }
    // The correction turned P into the space that the mesh was moved to; the mesh belongs in P's.
    MixedAxes back;
    for (std::size_t i = 0; i < back.size(); ++i) {
        const auto& axis = found.axes[i];
        back[static_cast<std::size_t>(axis.of_mesh)] = {static_cast<int>(i), axis.sign};
    }
    const MixedAxes axes = mixed_twice(file.space.axes, back);
    const bool is_left = mirrors(found.axes);
    const std::string units =
        found.factor == 1 ? "" : fmt::format(", and {}", unit_text(found, file));
    const std::string remedy =
        found.factor == 1 ? "" : fmt::format(" and {}", unit_remedy(found, file));
    return {is_left ? "handedness" : "axes",
            fmt::format("{}{}: set conventions.axes = {}{}",
                        is_left ? "P and the mesh differ in handedness: an axis is mirrored"
                                : "P and the mesh differ in axes, as if z were up instead of y",
                        units, axes_text(axes), remedy)};
}

/// Whether the positions look as if seen from the origin: then three of them in a line of the image
/// lie in a plane with it.
bool is_seen_from_origin(const scene::Image<Vec3f>& position)
{
    const auto [width, height] = position.size();
    std::size_t lines = 0;
    std::size_t flat = 0;
    const auto count = [&](const Vec3f& a, const Vec3f& b, const Vec3f& c) {
        const Vec3d u = glm::normalize(Vec3d{a});
        const Vec3d v = glm::normalize(Vec3d{b});
        const Vec3d w = glm::normalize(Vec3d{c});
        const double volume = glm::dot(glm::cross(u, v), w);
        if (std::isfinite(volume)) {
            ++lines;
            // float32 rounds each direction by 2^-24; earlier steps in the renderer add some.
            flat += std::abs(volume) <= 1e-5 * glm::length(glm::cross(u, w)) ? 1U : 0U;
        }
    };
    for (int i = 0; i < 64; ++i) {
        const int y = i * height / 64;
        const int x = i * width / 64;
        count(position(width / 8, y), position(width / 2, y), position(width - 1 - width / 8, y));
        count(position(x, height / 8), position(x, height / 2),
              position(x, height - 1 - height / 8));
    }
    return lines >= 16 && flat * 10 >= lines * 9;
}

ImportMistake unknown_mistake(const scene::CaseFile& file, const scene::CaseLayers& layers,
                              const ImportDistances& distances)
{
    if (is_seen_from_origin(layers.position)) {
        if (file.eye) { // adding the eye would have corrected a mere shift
            return {"view_space", "P is in view space: it looks as if seen from the origin, and "
                                  "adding camera.eye does not bring it onto the mesh; write world "
                                  "positions"};
        }
        return {"camera_relative", "P is relative to the camera: it looks as if seen from the "
                                   "origin, and is not on the mesh; write world positions"};
    }
    return {"positions",
            fmt::format("P is not on the mesh (its distance is {:.3g} m at the median, {:.3g} m at "
                        "99 %, and {:.3g} m are tolerated), and no usual mistake explains it: is "
                        "this the mesh that was rendered, where it was rendered? --tolerance-m "
                        "allows more",
                        distances.median_m, distances.p99_m, distances.tolerance_m)};
}

/// The mistake of positions that do not fit the mesh.
/// @param is_off  They exceed the tolerance.
std::optional<ImportMistake> find_mistake(const scene::CaseFile& file,
                                          const scene::CaseLayers& layers,
                                          const std::vector<Vec3d>& points,
                                          const MistakeFinder& finder, const scene::Camera& camera,
                                          const ImportDistances& distances, bool is_off)
{
    if (!is_off && !finder.may_be_shrunk()) {
        return std::nullopt;
    }
    const bool has_camera = file.says("camera.target") && !file.space.is_mirrored();
    if (const auto found = finder.find(file.eye, has_camera ? &camera : nullptr)) {
        return mistake_of(*found, file);
    }
    if (auto shared = check_shared_position(points)) {
        return shared;
    }
    return is_off ? std::optional{unknown_mistake(file, layers, distances)} : std::nullopt;
}

double reach_of_mesh(const scene::TriangleScene& mesh)
{
    const scene::Box box = mesh.bounds();
    const Vec3d reach = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    return std::max({reach.x, reach.y, reach.z});
}

} // namespace

std::vector<std::size_t> checked_pixels(const scene::Image<Vec3f>& position)
{
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < position.pixel_count(); ++i) {
        if (!std::isnan(position[i].x)) {
            pixels.push_back(i);
        }
    }
    return evenly_spread(pixels);
}

double nth_smallest(std::vector<double>& values, std::size_t index)
{
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

Vec3d winding_normal(const scene::TriangleScene& mesh, std::uint32_t triangle)
{
    const auto [a, b, c] = mesh.corners(triangle);
    return glm::cross(Vec3d{b} - Vec3d{a}, Vec3d{c} - Vec3d{a});
}

double default_tolerance_m(const scene::TriangleScene& scene, const scene::CaseSpace& space)
{
    return std::ldexp(reach_of_mesh(scene), -16) * space.metres_per_unit;
}

ImportDistances summarise_distances(std::span<const double> distances, double metres_per_unit,
                                    double tolerance_m)
{
    std::vector<double> values{distances.begin(), distances.end()};
    ImportDistances summary;
    summary.points = values.size();
    summary.median_m = quantile(values, 0.5) * metres_per_unit;
    summary.p99_m = quantile(values, 0.99) * metres_per_unit;
    summary.max_m = *std::ranges::max_element(values) * metres_per_unit;
    summary.tolerance_m = tolerance_m;
    return summary;
}

PositionCheck check_positions(const scene::CaseFile& file, const scene::CaseLayers& layers,
                              const scene::TriangleScene& mesh, const scene::Camera& camera,
                              const renderers::RoundedReference& truth, double tolerance_m)
{
    const std::vector<Vec3d> points = checked_points(layers.position);
    PositionCheck check;
    check.distances =
        summarise_distances(distances_of(truth, points), file.space.metres_per_unit, tolerance_m);
    const bool is_off = !(check.distances.p99_m <= tolerance_m);
    const double reach = reach_of_mesh(mesh);
    const MistakeFinder finder{truth, points, reach,
                               tolerance_m / file.space.metres_per_unit / reach};
    if (are_rounded_to_half(layers.position, is_off)) {
        check.mistake = {"half_float",
                         "P was rounded to half floats before it was written: near 100 half's step "
                         "is 0.0625, and no shadow can be judged from there; render and write full "
                         "floats"};
    } else {
        check.mistake = find_mistake(file, layers, points, finder, camera, check.distances, is_off);
    }
    if (!check.mistake) {
        check.mistake = check_shared_position(points);
    }
    return check;
}

} // namespace gnomon::analysis
