#pragma once

#include "analysis/evaluate/position_check.hpp"
#include "renderers/reference.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/rounded_receivers.hpp"

#include <optional>

namespace gnomon::analysis {

/// How well a mask agrees with the truth, on scored pixels; where the light is behind the surface
/// that is seen, masks follow no convention.
struct MaskAgreement {
    std::uint64_t lit = 0;
    std::uint64_t lit_right = 0;
    std::uint64_t blocked = 0;
    std::uint64_t blocked_right = 0;
    double lit_light = 0;     ///< sum of the mask over lit pixels
    double blocked_light = 0; ///< and over blocked ones

    /// Share of lit pixels that are lit plus share of blocked ones that are shadowed, minus 1: 1
    /// where they agree, 0 where the mask says nothing, −1 where it is inverted (Youden's J). The
    /// share of a kind without pixels is one half.
    [[nodiscard]] double index() const;
    [[nodiscard]] bool has_both() const { return lit > 0 && blocked > 0; }
    /// The mask's mean over lit pixels less that over blocked ones: above 0 where shadows are too
    /// light to count, too; 0 where the mask says nothing, and where a kind has no pixels.
    [[nodiscard]] double darkening() const;
};

/// Counts the scored pixels, and those that the mask gets right.
[[nodiscard]] MaskAgreement agreement(const scene::Image<float>& mask,
                                      const scene::Image<scene::PixelClass>& classes);

/// The mistake that a mask shows by itself: edges with fractions, where one sample has none. Empty
/// if hardly any are, or where the case says that fractions are meant or that a filter made them.
/// @param job  what the file says, with the defaults of what it does not.
[[nodiscard]] std::optional<ImportMistake> check_fractions(const scene::CaseFile& file,
                                                           const scene::Job& job,
                                                           const scene::CaseLayers& layers);

/// Whether the mask is both lit and dark, and tells only which side of the mesh's triangles, as
/// they are wound, is turned to the light: a picture without cast shadows, as of a renderer whose
/// shadows are off or of a scene in which nothing casts. A hundredth of the pixels may differ, and
/// a tenth of those in cast shadows.
/// @param truth  of the case's light.
[[nodiscard]] bool shows_shading_alone(const scene::CaseLayers& layers, const scene::Light& light,
                                       const scene::RoundedTruth& truth,
                                       const scene::TriangleScene& mesh);

/// The mistake that explains far better how a mask differs from the truth than the renderer's own
/// errors could: an inverted mask, a flipped image, the light on another side or its axes mixed up.
///
/// A mask that is all lit or all shadowed shows none of them, and is left to the scores.
/// @param truth  of `receivers` and the case's light.
/// @return  Empty if no mistake explains it.
[[nodiscard]] std::optional<ImportMistake> check_mask(const scene::CaseLayers& layers,
                                                      const scene::Light& light,
                                                      const scene::RoundedReceivers& receivers,
                                                      const scene::RoundedTruth& truth,
                                                      const renderers::RoundedReference& finders);

} // namespace gnomon::analysis
