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

/// Claims about what is true of each pixel, for `certify` to test.
struct TruthClaims {
    scene::Image<std::uint32_t> receiver; ///< GL's triangle, or `no_triangle`
    scene::Image<scene::PixelClass> pixel_class;
    scene::Image<float> truth;           ///< 1 lit, 0 blocked, −1 not scored
    scene::Image<std::uint32_t> witness; ///< a triangle that blocks, `no_triangle` unless `blocked`
    scene::Image<scene::Vec3f> position; ///< P; not a number where there is no receiver
};

struct CertificateOptions {
    /// Surface pixels to derive anew; empty: `default_sample_size`.
    std::optional<std::uint64_t> sample;
    std::uint64_t seed = 0;
    int threads = 0; ///< 0: all cores
    /// Called now and then, by one thread at a time: stage, and pixels of it done and in all.
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

/// What the certificate is about, and what it found. Counts are of pixels.
struct Certificate {
    using ClassCounts = std::array<std::uint64_t, scene::pixel_class_count>;

    ClassCounts claimed{};
    std::uint64_t witnesses = 0;         ///< blocked pixels, every one of which was checked
    std::uint64_t seams = 0;             ///< blocked pixels whose witness is one of a seam's two
    std::uint64_t positions = 0;         ///< pixels with a receiver, whose P was checked
    std::uint64_t surface_pixels = 0;    ///< what is not claimed to be background
    std::uint64_t sampled = 0;           ///< surface pixels drawn at random and derived anew
    ClassCounts derived{};               ///< derived anew in all, by the class claimed
    std::uint64_t silhouettes = 0;       ///< kinds of the indeterminate pixels derived anew
    std::uint64_t vertices = 0;          ///< "
    std::uint64_t grazes = 0;            ///< "
    std::uint64_t wrong = 0;             ///< pixels refuted
    std::vector<Refutation> refutations; ///< the first of them, in the image's order; at most 100

    [[nodiscard]] bool is_certified() const { return wrong == 0; }
    /// Largest share of wrong surface pixels that the sample leaves possible at 95 % confidence:
    /// 3/k for k pixels drawn without a wrong one, 0 if that was every one of them; empty if there
    /// is no surface, or if the claims are refuted.
    [[nodiscard]] std::optional<double> error_rate_bound() const;
};

/// Tests claims about an image with rational arithmetic and brute force, sharing no code with
/// `compute_truth`.
///
/// Of every pixel: its truth and receiver fit its class, P is its receiver's, there is a witness if
/// and only if it is blocked, and the witness blocks. Of every background pixel and of a sample:
/// the class, derived from all triangles. The sample is drawn from the surface pixels; of every
/// other class it is filled up to a twentieth of its size, of `indeterminate` to its full size,
/// with pixels that do not count towards `sampled`. It depends on seed, size and claims only.
/// @param scene, view  The exact inputs.
/// @throws std::invalid_argument  if an image is not of the view's size.
[[nodiscard]] Certificate certify(const scene::TriangleScene& scene, const scene::View& view,
                                  const TruthClaims& claims, const CertificateOptions& options);

} // namespace gnomon::reference_rt
