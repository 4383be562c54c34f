#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/view/view.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reference_rt {

/// Claims about each pixel's truth, which `certify` tests.
struct TruthClaims {
    scene::Image<std::uint32_t> receiver; ///< GL's triangle, or `no_triangle`
    scene::Image<scene::PixelClass> pixel_class;
    scene::Image<float> truth;           ///< 1 lit, 0 blocked, −1 not scored
    scene::Image<std::uint32_t> witness; ///< a blocking triangle; `no_triangle` unless `blocked`
    scene::Image<scene::Vec3f> position; ///< P; NaN without a receiver
};

struct CertificateOptions {
    /// Number of surface pixels to derive; empty for `default_sample_size`.
    std::optional<std::uint64_t> sample;
    std::uint64_t seed = 0;
    int threads = 0; ///< 0 for all cores
    /// Called now and then, by one thread at a time, with the stage and its finished and total
    /// pixels.
    std::function<void(std::string_view, std::uint64_t, std::uint64_t)> progress{};
};
/// 3,000, or 300 above 100,000 triangles.
[[nodiscard]] std::uint64_t default_sample_size(const scene::TriangleScene& scene);

/// A pixel whose claim is wrong.
struct Refutation {
    int x = 0;
    int y = 0;
    scene::PixelClass claimed = scene::PixelClass::background;
    std::string reason; ///< names triangles and signs
};

/// The result of `certify`. Counts are numbers of pixels.
struct Certificate {
    using ClassCounts = std::array<std::uint64_t, scene::pixel_class_count>;

    ClassCounts claimed{};
    std::uint64_t witnesses = 0;         ///< blocked pixels, all checked
    std::uint64_t seams = 0;             ///< blocked pixels whose witness belongs to a seam
    std::uint64_t positions = 0;         ///< pixels with a receiver, whose P was checked
    std::uint64_t surface_pixels = 0;    ///< pixels not claimed as background
    std::uint64_t sampled = 0;           ///< surface pixels drawn at random and derived
    ClassCounts derived{};               ///< all derived pixels, by claimed class
    std::uint64_t silhouettes = 0;       ///< derived indeterminate pixels, by reason
    std::uint64_t vertices = 0;          ///< "
    std::uint64_t grazes = 0;            ///< "
    std::uint64_t wrong = 0;             ///< pixels refuted
    std::vector<Refutation> refutations; ///< the first 100 in image order

    [[nodiscard]] bool is_certified() const { return wrong == 0; }
    /// Upper bound of the share of wrong surface pixels at 95 % confidence: 3/k after k correct
    /// draws, 0 if all pixels were drawn; empty without surface pixels, or if the claims are
    /// refuted.
    [[nodiscard]] std::optional<double> error_rate_bound() const;
};

/// Tests claims about an image with rational arithmetic and brute force, sharing no code with
/// `compute_truth`.
///
/// Checks for every pixel that truth and receiver fit its class, that P lies on its receiver, that
/// it has a witness if and only if it is blocked, and that the witness blocks. Derives the class
/// from all triangles for every background pixel and for a sample. The sample is drawn from the
/// surface pixels. Rare classes get extra pixels, which do not count towards `sampled`: up to a
/// twentieth of the sample's size for each class, and up to its full size for `indeterminate`. The
/// sample depends only on seed, size and claims.
/// @param scene, view  The exact inputs.
/// @throws std::invalid_argument  if an image's size differs from the view's.
[[nodiscard]] Certificate certify(const scene::TriangleScene& scene, const scene::View& view,
                                  const TruthClaims& claims, const CertificateOptions& options);

} // namespace gnomon::reference_rt
