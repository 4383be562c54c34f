#pragma once

#include "reference_rt/certificate/boxes.hpp"
#include "reference_rt/certificate/rational_geometry.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::reference_rt::certificate {

/// What is true of one pixel, and the triangle that makes it so.
struct Finding {
    scene::PixelClass pixel_class = scene::PixelClass::lit;
    scene::ClassReason reason = scene::ClassReason::none; ///< of `indeterminate`
    std::uint32_t triangle = scene::no_triangle; ///< the first hit, or what meets the segment
    std::uint32_t partner = scene::no_triangle;  ///< the other triangle of a seam
    ContactSigns signs{};                        ///< of `triangle`, where one meets the segment
};
/// "triangle 8 crosses the segment to the light (signs: edges +++, P -, light +)".
[[nodiscard]] std::string explain(const Finding& finding);

/// Whether a pixel's witness blocks it.
struct WitnessVerdict {
    std::string fault; ///< empty if it does; else a sentence that says why not
    bool is_seam = false;
};

/// Decides pixels with rational numbers alone, trying every triangle of a scene.
class BruteForce {
public:
    /// Both must outlive this object. Any number of threads may ask it.
    BruteForce(const scene::TriangleScene& scene, const scene::View& view);

    /// The class of a pixel in which GL drew `receiver` (`no_triangle`: nothing).
    [[nodiscard]] Finding decide(int x, int y, std::uint32_t receiver) const;

    /// Whether `witness`, or the seam of which it is the lower triangle, crosses the segment from
    /// the pixel's point of `receiver` to the light, and nothing speaks against a blocked pixel but
    /// other triangles that the camera might see first.
    [[nodiscard]] WitnessVerdict check_witness(int x, int y, std::uint32_t receiver,
                                               std::uint32_t witness) const;

    /// Why a position cannot be that of the pixel's point of `receiver`: farther from the exact one
    /// than doubles and one rounding to float32 lead; empty if it can.
    [[nodiscard]] std::string check_position(int x, int y, std::uint32_t receiver,
                                             const scene::Vec3f& position) const;

private:
    struct FirstHits {
        std::vector<std::uint32_t> triangles;
        Fraction t;
    };

    [[nodiscard]] Triangle triangle(std::uint32_t index) const;
    [[nodiscard]] bool is_triangle(std::uint32_t index) const;
    [[nodiscard]] CameraRay ray(int x, int y) const;
    /// Everything that the ray meets at the smallest t beyond the near plane, in order.
    [[nodiscard]] FirstHits first_hits(const CameraRay& ray) const;
    [[nodiscard]] Finding decide_segment(const Point& p, std::uint32_t receiver) const;
    [[nodiscard]] std::optional<Finding> contact(const Point& p, std::uint32_t candidate) const;
    [[nodiscard]] std::uint32_t seam_partner(std::uint32_t triangle, std::size_t edge) const;

    const scene::TriangleScene& scene_;
    const scene::View& view_;
    std::vector<scene::TriangleRange> casting_;
    TriangleBoxes receivers_;
    TriangleBoxes casters_;
    Point light_;
    Fraction near_;
};

} // namespace gnomon::reference_rt::certificate
