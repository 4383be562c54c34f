#include "analysis/evaluate/case_checks.hpp"

#include "scene/job/toml.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::NearestSurface;
using scene::no_object;
using scene::no_triangle;
using scene::Vec3d;

/// Some pixels, evenly spread, and the surface nearest to each one's position.
struct SampledPixels {
    std::vector<std::size_t> pixels;
    std::vector<Vec3d> points;
    std::vector<NearestSurface> nearest;
};

SampledPixels sample_pixels(const scene::RoundedReceivers& receivers,
                            const renderers::RoundedReference& truth)
{
    SampledPixels sampled;
    sampled.pixels = checked_pixels(receivers.position);
    for (const std::size_t pixel : sampled.pixels) {
        sampled.points.emplace_back(receivers.position[pixel]);
    }
    sampled.nearest = truth.nearest_surfaces(sampled.points, {});
    return sampled;
}

/// The object that most positions with a number lie on.
class NumberedObjects {
public:
    NumberedObjects(const SampledPixels& sampled, const scene::CaseLayers& layers,
                    const scene::TriangleScene& mesh)
    {
        std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> votes;
        for (std::size_t i = 0; i < sampled.pixels.size(); ++i) {
            if (const std::uint32_t t = sampled.nearest[i].triangle; t != no_triangle) {
                const auto object = static_cast<std::uint32_t>(mesh.object_of(t));
                ++votes[layers.object_number[sampled.pixels[i]]][object];
            }
        }
        std::size_t agreeing = 0;
        for (const auto& [number, objects] : votes) {
            const auto most = std::ranges::max_element(
                objects, {}, [](const auto& entry) { return entry.second; });
            agreeing += most->second;
            // A few pixels along edges do not count.
            if (most->second * 100 >= sampled.pixels.size()) {
                object_of_[number] = most->first;
            }
        }
        explains_ = agreeing * 20 >= sampled.pixels.size() * 19;
    }

    /// What the numbers mean, if a constant shift or another table explains them; else empty.
    /// @param expected  The case's number of each object, by its index.
    [[nodiscard]] std::string explanation(const std::map<std::uint32_t, std::uint32_t>& expected,
                                          const scene::TriangleScene& mesh, bool has_table) const
    {
        std::set<std::uint32_t> objects;
        std::set<std::int64_t> shifts;
        std::string table;
        std::size_t listed = 0;
        for (const auto& [number, object] : object_of_) {
            objects.insert(object);
            const auto own = expected.find(object);
            shifts.insert(own == expected.end() ? 0 : std::int64_t{number} - own->second);
            if ((own == expected.end() || own->second != number) && ++listed <= 4) {
                table += fmt::format("{}{} = {}", table.empty() ? "" : ", ",
                                     scene::toml_excerpt({mesh.objects[object].name}), number);
            }
        }
        if (!explains_ || objects.size() != object_of_.size()) {
            return {};
        }
        if (shifts.size() == 1 && *shifts.begin() != 0) {
            return fmt::format("every number is {} {} than {}", std::abs(*shifts.begin()),
                               *shifts.begin() > 0 ? "larger" : "smaller",
                               has_table ? "[objects] says"
                                         : "the object's place in the mesh file, from 0");
        }
        return fmt::format("they fit with {}{}", table, listed > 4 ? ", …" : "");
    }

private:
    std::map<std::uint32_t, std::uint32_t> object_of_; ///< by number
    bool explains_ = false; ///< nearly all positions with a number lie on one object
};

/// The case's number of each object, by its index.
std::map<std::uint32_t, std::uint32_t> expected_numbers(const scene::CaseFile& file,
                                                        const scene::TriangleScene& mesh)
{
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < mesh.objects.size(); ++i) {
        const auto given = file.object_numbers.find(mesh.objects[i].name);
        if (given != file.object_numbers.end()) {
            numbers[i] = given->second;
        } else if (file.object_numbers.empty()) {
            numbers[i] = i;
        }
    }
    return numbers;
}

/// @param tolerance  [the renderer's units]
std::optional<ImportMistake>
check_numbers(const scene::CaseFile& file, const scene::CaseLayers& layers,
              const scene::TriangleScene& mesh, const scene::RoundedReceivers& receivers,
              const SampledPixels& sampled, const renderers::RoundedReference& truth,
              double tolerance)
{
    if (receivers.object.empty()) {
        return std::nullopt;
    }
    std::vector<scene::SurfaceScope> scopes;
    for (const std::size_t pixel : sampled.pixels) {
        scopes.push_back({receivers.object[pixel], tolerance});
    }
    const auto own = truth.nearest_surfaces(sampled.points, scopes);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        wrong +=
            sampled.nearest[i].distance_m <= tolerance && own[i].triangle == no_triangle ? 1U : 0U;
    }
    if (wrong * 100 <= own.size()) {
        return std::nullopt;
    }
    const std::string explanation = NumberedObjects{sampled, layers, mesh}.explanation(
        expected_numbers(file, mesh), mesh, !file.object_numbers.empty());
    return ImportMistake{
        "object_numbers",
        fmt::format("id.geom names other objects than those that P lies on, at {:.2g} % of the "
                    "pixels{}{}: correct [objects], which gives each object of the mesh its "
                    "number, or leave id.geom out",
                    100.0 * static_cast<double>(wrong) / static_cast<double>(own.size()),
                    explanation.empty() ? "" : "; ", explanation)};
}

/// The median of |cos| between Ng and the triangles' normals; empty if no Ng is known.
std::optional<double> median_cosine(const scene::CaseLayers& layers,
                                    const scene::TriangleScene& mesh, const SampledPixels& sampled)
{
    std::vector<double> cosines;
    for (std::size_t i = 0; i < sampled.pixels.size(); ++i) {
        if (sampled.nearest[i].triangle == no_triangle) {
            continue;
        }
        const Vec3d normal = glm::normalize(winding_normal(mesh, sampled.nearest[i].triangle));
        const double cosine =
            std::abs(glm::dot(glm::normalize(Vec3d{layers.normal[sampled.pixels[i]]}), normal));
        if (std::isfinite(cosine)) {
            cosines.push_back(cosine);
        }
    }
    if (cosines.empty()) {
        return std::nullopt;
    }
    return nth_smallest(cosines, cosines.size() / 2);
}

/// Whether Ng is on the side away from the eye at more than half of the pixels.
bool points_away(const scene::CaseLayers& layers, const Vec3d& eye, const SampledPixels& sampled)
{
    std::size_t away = 0;
    std::size_t towards = 0;
    for (std::size_t i = 0; i < sampled.pixels.size(); ++i) {
        const double side =
            glm::dot(Vec3d{layers.normal[sampled.pixels[i]]}, eye - sampled.points[i]);
        away += side < 0 ? 1U : 0U;
        towards += side > 0 ? 1U : 0U;
    }
    return away > towards;
}

std::optional<ImportMistake> check_normals(const scene::CaseFile& file,
                                           const scene::CaseLayers& layers,
                                           const scene::TriangleScene& mesh,
                                           const SampledPixels& sampled)
{
    if (layers.normal.empty()) {
        return std::nullopt;
    }
    // Smooth shading's normals are nearer than acos(0.9), 26 degrees, on all but the coarsest
    // meshes; random ones have a median of 0.5.
    const auto cosine = median_cosine(layers, mesh, sampled);
    if (!cosine) {
        return std::nullopt;
    }
    if (*cosine < 0.9) {
        return ImportMistake{
            "normals", fmt::format("Ng is not the geometric normal of the mesh (the cosine between "
                                   "them is {:.2g} at the median): leave it out, or write the flat "
                                   "normal in the space of P",
                                   *cosine)};
    }
    if (file.eye && points_away(layers, *file.eye, sampled)) {
        return ImportMistake{"normals", "Ng points away from camera.eye at most pixels: negate it, "
                                        "for it is on the side that is seen"};
    }
    return std::nullopt;
}

} // namespace

std::optional<ImportMistake>
check_surfaces(const scene::CaseFile& file, const scene::CaseLayers& layers,
               const scene::TriangleScene& mesh, const scene::RoundedReceivers& receivers,
               const renderers::RoundedReference& truth, double tolerance_m)
{
    if (receivers.object.empty() && layers.normal.empty()) {
        return std::nullopt;
    }
    const SampledPixels sampled = sample_pixels(receivers, truth);
    const double tolerance = tolerance_m / file.space.metres_per_unit;
    auto mistake = check_numbers(file, layers, mesh, receivers, sampled, truth, tolerance);
    return mistake ? mistake : check_normals(file, layers, mesh, sampled);
}

} // namespace gnomon::analysis
