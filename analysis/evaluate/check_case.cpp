#include "analysis/evaluate/evaluate.hpp"

#include "analysis/evaluate/case_checks.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace gnomon::analysis {

namespace {

/// In a mask with shadows, blocked pixels are on average darker than lit ones by at least this
/// share of the light, even if the shadows are too light to count. In an uninformative mask the
/// means of some thousand pixels differ by a hundredth.
constexpr double least_darkening = 0.05;

/// The mesh's objects by the renderer's numbers.
std::map<std::uint32_t, std::uint32_t> objects_by_number(const Case& subject)
{
    std::map<std::uint32_t, std::uint32_t> objects;
    const auto& names = subject.file.object_numbers;
    for (std::uint32_t i = 0; names.empty() && i < subject.mesh.objects.size(); ++i) {
        objects[i] = i;
    }
    for (const auto& [name, number] : names) {
        const auto found = std::ranges::find(subject.mesh.objects, name, &scene::Object::name);
        if (found == subject.mesh.objects.end()) {
            std::vector<std::string> known;
            for (const scene::Object& object : subject.mesh.objects) {
                known.push_back(object.name);
            }
            throw scene::InputError(
                fmt::format("{}: objects.{}: the mesh has no such object; the nearest is {}",
                            subject.file.source.name, scene::toml_excerpt({name}),
                            scene::toml_excerpt({scene::nearest_word(name, known)})));
        }
        objects[number] =
            static_cast<std::uint32_t>(std::distance(subject.mesh.objects.begin(), found));
    }
    return objects;
}

scene::RoundedReceivers receivers_of(const Case& subject)
{
    const scene::CaseLayers& layers = subject.layers;
    scene::RoundedReceivers receivers{layers.position, layers.normal, subject.file.eye};
    const auto objects = objects_by_number(subject);
    if (!layers.object_number.empty()) {
        receivers.object = scene::Image<std::uint32_t>{layers.size(), scene::no_object};
        for (std::size_t i = 0; i < receivers.object.pixel_count(); ++i) {
            const auto found = objects.find(layers.object_number[i]);
            if (found != objects.end() && subject.mesh.objects[found->second].receives) {
                receivers.object[i] = found->second;
            }
        }
    }
    return receivers;
}

/// The job that the case describes, with the size of its image.
scene::Job job_of(const Case& subject)
{
    scene::Job job = scene::make_job(subject.file.source);
    job.image = subject.layers.size();
    return job;
}

void note(ImportCheck& check, const std::optional<ImportMistake>& mistake)
{
    if (mistake && check.mistake.empty()) {
        check.mistake = mistake->name;
        check.sentence = mistake->sentence;
    }
}

/// Measures the distances of all positions, which the truth has found.
void measure_distances(const Case& subject, CheckedCase& checked)
{
    std::vector<double> distances;
    for (std::size_t i = 0; i < checked.truth.distance_m.pixel_count(); ++i) {
        if (!std::isnan(subject.layers.position[i].x)) {
            distances.push_back(double{checked.truth.distance_m[i]});
        }
    }
    ImportDistances& found = checked.check.distances;
    found = summarise_distances(distances, subject.file.space.metres_per_unit, found.tolerance_m);
}

/// Compares the mask with the truth.
void check_agreement(const Case& subject, const renderers::RoundedReference& truth,
                     CheckedCase& checked)
{
    ImportCheck& check = checked.check;
    const MaskAgreement found = agreement(subject.layers.mask, checked.truth.truth.pixel_class);
    if (found.has_both()) {
        check.agreement = found.index();
    }
    if (found.index() <= 0.5 &&
        shows_shading_alone(subject.layers, checked.view.light, checked.truth, subject.mesh)) {
        check.warning = "the mask shows no cast shadow: it is dark only where surfaces are turned "
                        "from the light; its shadows may be switched off";
        return;
    }
    note(check,
         check_mask(subject.layers, checked.view.light, checked.receivers, checked.truth, truth));
    if (found.lit + found.blocked == 0) {
        check.warning =
            "no pixel is scored: each faces away from the light, is outside its cone, or is "
            "too far from its surface; check the light, and Ng or camera.eye";
    } else if (check.mistake.empty() && check.agreement.value_or(1) <= 0 &&
               found.darkening() < least_darkening) {
        check.warning = "mask and truth agree no better than by chance, and no usual mistake "
                        "explains it: check the light and the mask";
    }
}

/// If P is the camera's, only the mask can reveal a wrong camera.
void warn_of_camera(ImportCheck& check)
{
    if (!check.silhouette_pixels || !check.mistake.empty() || !check.warning.empty()) {
        return;
    }
    constexpr double likely_agreement = 0.5;
    constexpr std::uint64_t usual_share = 20;
    const std::uint64_t shown = check.distances.points + *check.silhouette_pixels;
    if (check.agreement.value_or(1) < likely_agreement) {
        check.warning =
            "mask and truth agree poorly, and P follows from the camera: check camera.eye, "
            "camera.target, camera.up, the units, and camera.vertical_fov_deg, which is "
            "the vertical opening; or write P";
    } else if (*check.silhouette_pixels * usual_share > shown) {
        check.warning = fmt::format(
            "{:.0f} % of the pixels that show something are set aside, for a "
            "silhouette may cross them: an open or finely detailed mesh, or "
            "a small image; write P to have them judged",
            100.0 * static_cast<double>(*check.silhouette_pixels) / static_cast<double>(shown));
    }
}

} // namespace

CheckedCase check_case(const Case& subject, const renderers::RoundedReference& truth,
                       std::optional<double> tolerance_m)
{
    CheckedCase checked;
    checked.job = job_of(subject);
    checked.view = scene::resolve_view(checked.job, subject.mesh, {});
    checked.receivers = receivers_of(subject);
    const double usual_m = default_tolerance_m(subject.mesh, subject.file.space);
    const double tolerated_m = tolerance_m.value_or(usual_m);
    const PositionCheck positions = check_positions(subject.file, subject.layers, subject.mesh,
                                                    checked.view.camera, truth, tolerated_m);
    ImportCheck& check = checked.check;
    check.distances = positions.distances;
    if (!subject.layers.has_positions) {
        check.silhouette_pixels = subject.layers.silhouette_pixels;
    }
    note(check, positions.mistake);
    // The work grows with the boxes, and the tolerance may span the whole scene.
    constexpr double most_of_usual = 64;
    const double most_m = std::clamp(tolerated_m, usual_m, most_of_usual * usual_m);
    checked.receivers.most_distance_m = most_m / subject.file.space.metres_per_unit;
    if (!positions.mistake) {
        note(check, check_surfaces(subject.file, subject.layers, subject.mesh, checked.receivers,
                                   truth, most_m));
    }
    if (subject.file.says("camera.target") && !subject.file.space.is_mirrored()) {
        note(check, check_camera(checked.view, subject.layers));
    }
    if (!check.mistake.empty()) {
        return checked;
    }
    checked.truth = truth.find_rounded_truth(checked.view.light, checked.receivers);
    measure_distances(subject, checked);
    note(check, check_levels(subject.file, checked.job, subject.layers, checked.view.light,
                             checked.truth, subject.mesh));
    note(check, check_fractions(subject.file, checked.job, subject.layers));
    if (check.mistake.empty()) {
        note(check, check_other_cameras(subject, checked, truth));
    }
    if (check.mistake.empty()) {
        check_agreement(subject, truth, checked);
        warn_of_camera(check);
    }
    return checked;
}

} // namespace gnomon::analysis
