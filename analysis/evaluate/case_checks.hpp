#pragma once

#include "analysis/comparison/evaluation.hpp"
#include "analysis/evaluate/checked_case.hpp"
#include "renderers/reference.hpp"
#include "scene/camera/camera.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A likely mistake of a case: its name, and a sentence with the remedy.
struct ImportMistake {
    std::string name;
    std::string sentence;
};

/// How far positions may be from their surfaces [m]: 2^-16 of the mesh's largest coordinate.
///
/// Rounding to float32 moves a coordinate by at most 2^-24 of it; the rest allows for float32
/// arithmetic in the renderer. Rounding to half moves it by up to 2^-12.
[[nodiscard]] double default_tolerance_m(const scene::TriangleScene& scene,
                                         const scene::CaseSpace& space);

/// @param distances  [the renderer's units]; not empty.
[[nodiscard]] ImportDistances summarise_distances(std::span<const double> distances,
                                                  double metres_per_unit, double tolerance_m);

/// Positions compared with the mesh.
struct PositionCheck {
    ImportDistances distances; ///< of some positions, evenly spread
    std::optional<ImportMistake> mistake;
};

/// Whether positions are on the mesh, and if not, which mistake puts them there: half floats,
/// units, axes, handedness, view space, camera-relative, or the position of pixels that show
/// nothing.
/// @param mesh    In the renderer's space.
/// @param camera  The case's, if it has a whole one.
/// @param truth   Of that mesh.
[[nodiscard]] PositionCheck
check_positions(const scene::CaseFile& file, const scene::CaseLayers& layers,
                const scene::TriangleScene& mesh, const scene::Camera& camera,
                const renderers::RoundedReference& truth, double tolerance_m);

/// True if a half float holds the number exactly.
[[nodiscard]] bool is_half(float value);

/// Whether positions look as if they had once been half floats.
///
/// All are values of half, and they are off their surfaces, repeat from pixel to pixel, or step
/// unevenly along rows. An orthographic camera that faces a plane may give exact positions that are
/// all values of half; they step evenly and do not repeat.
/// @param is_off_surfaces  They are not on the mesh.
[[nodiscard]] bool are_rounded_to_half(const scene::Image<scene::Vec3f>& position,
                                       bool is_off_surfaces);

/// The mistake of a position that at least a hundredth of the points share bit by bit, as a cleared
/// background does; empty if there is none.
///
/// Where float32 is too coarse for a camera, neighbours repeat each other too, but about equally
/// often: no position is ten times as frequent as the next.
[[nodiscard]] std::optional<ImportMistake>
check_shared_position(std::span<const scene::Vec3d> points);

/// The mistake of object numbers or normals that do not suit the surfaces that P lies on; empty if
/// they do, or the case has neither.
///
/// Numbers: with them, more than a hundredth of the positions is farther off than tolerated;
/// without them, not. Normals: at half the pixels or more, their angle to the triangles' normals
/// exceeds acos(0.9), sides ignored, or they point away from the eye.
/// @param mesh       In the renderer's space, with its roles.
/// @param receivers  Of the case.
/// @param truth      Of that mesh.
[[nodiscard]] std::optional<ImportMistake>
check_surfaces(const scene::CaseFile& file, const scene::CaseLayers& layers,
               const scene::TriangleScene& mesh, const scene::RoundedReceivers& receivers,
               const renderers::RoundedReference& truth, double tolerance_m);

/// The mistake of an image that is flipped against its case's camera; empty if it is not, or the
/// camera is orthographic.
[[nodiscard]] std::optional<ImportMistake> check_camera(const scene::View& view,
                                                        const scene::CaseLayers& layers);

/// The mistake of a case without positions whose camera is not the renderer's.
///
/// If mask and truth agree by less than 0.9, or the mask has values where the camera sees nothing,
/// other cameras are tried: the opening angle as that of another side of the image or of half of
/// it, and other up axes. A camera is named if it explains the mask far better. If none does, the
/// given camera is named if the mask has values at more than a fiftieth of the pixels where it sees
/// nothing.
/// @param checked  With its job, view and receivers.
/// @return  Empty if there is no such mistake, or the case has positions.
[[nodiscard]] std::optional<ImportMistake>
check_other_cameras(const Case& subject, const CheckedCase& checked,
                    const renderers::RoundedReference& truth);

/// How well a mask agrees with the truth on scored pixels. Others do not count: masks follow no
/// convention where the light is behind the visible surface.
struct MaskAgreement {
    std::uint64_t lit = 0;
    std::uint64_t lit_right = 0;
    std::uint64_t blocked = 0;
    std::uint64_t blocked_right = 0;
    double lit_light = 0;     ///< sum of the mask over lit pixels
    double blocked_light = 0; ///< sum of the mask over blocked pixels

    /// Share of lit pixels that are lit, plus share of blocked ones that are shadowed, minus 1
    /// (Youden's J): 1 for a perfect mask, 0 for an uninformative one, −1 for an inverted one. The
    /// share of a kind without pixels is one half.
    [[nodiscard]] double index() const;
    [[nodiscard]] bool has_both() const { return lit > 0 && blocked > 0; }
    /// The mask's mean over lit pixels minus that over blocked ones. Positive for shadows that are
    /// too light to count, too; 0 if the mask is uninformative or a kind has no pixels.
    [[nodiscard]] double darkening() const;
};

/// Counts the scored pixels, and those that the mask gets right.
[[nodiscard]] MaskAgreement agreement(const scene::Image<float>& mask,
                                      const scene::Image<scene::PixelClass>& classes);

/// The mistake of a mask with fractions along its edges, although it has one sample a pixel. Empty
/// if hardly any pixel has one, or the case declares fractions or a filter that makes them.
/// @param job  The file's, with defaults for the keys that it leaves out.
[[nodiscard]] std::optional<ImportMistake> check_fractions(const scene::CaseFile& file,
                                                           const scene::Job& job,
                                                           const scene::CaseLayers& layers);

/// Whether the mask shows only which side of the mesh's triangles, as they are wound, faces the
/// light: a picture without cast shadows, as from a renderer whose shadows are off. It has lit and
/// dark pixels; up to a hundredth of all may differ, and a tenth of those in cast shadows.
/// @param truth  Of the case's light.
[[nodiscard]] bool shows_shading_alone(const scene::CaseLayers& layers, const scene::Light& light,
                                       const scene::RoundedTruth& truth,
                                       const scene::TriangleScene& mesh);

/// The mistake that explains the difference between mask and truth far better than the renderer's
/// own errors could: an inverted mask, a flipped image, a light on another side or with mixed-up
/// axes.
///
/// A mask that is all lit or all shadowed shows none of them; its scores tell enough.
/// @param truth  Of `receivers` and the case's light.
/// @return  Empty if no mistake explains it.
[[nodiscard]] std::optional<ImportMistake> check_mask(const scene::CaseLayers& layers,
                                                      const scene::Light& light,
                                                      const scene::RoundedReceivers& receivers,
                                                      const scene::RoundedTruth& truth,
                                                      const renderers::RoundedReference& finders);

/// The mistake of a mask whose values are not the share of light that a lookup lets through: light
/// times the cosine of its angle, or two values other than 0 and 1. Empty if it is neither, or the
/// case declares what its values mean.
/// @param job    The file's, with defaults for the keys that it leaves out.
/// @param truth  Of the case's light.
[[nodiscard]] std::optional<ImportMistake>
check_levels(const scene::CaseFile& file, const scene::Job& job, const scene::CaseLayers& layers,
             const scene::Light& light, const scene::RoundedTruth& truth,
             const scene::TriangleScene& mesh);

/// Most pixels of a case that a check asks the reference about.
inline constexpr std::size_t most_checked_pixels = 16384;

/// At most so many of the values, evenly spread.
template <typename Value>
[[nodiscard]] std::vector<Value> evenly_spread(const std::vector<Value>& values,
                                               std::size_t most = most_checked_pixels)
{
    std::vector<Value> chosen;
    const std::size_t count = std::min(values.size(), most);
    for (std::size_t i = 0; i < count; ++i) {
        chosen.push_back(values[i * values.size() / count]);
    }
    return chosen;
}

/// Pixels that have a position, at most `most_checked_pixels`, evenly spread.
[[nodiscard]] std::vector<std::size_t> checked_pixels(const scene::Image<scene::Vec3f>& position);

/// The value at an index of the sorted values; reorders them.
[[nodiscard]] double nth_smallest(std::vector<double>& values, std::size_t index);

/// The normal of a triangle on its front, as it is wound; not normalised.
[[nodiscard]] scene::Vec3d winding_normal(const scene::TriangleScene& mesh, std::uint32_t triangle);

} // namespace gnomon::analysis
