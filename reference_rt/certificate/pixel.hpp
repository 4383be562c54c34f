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

/// A pixel's class, and the triangle that decides it.
struct Finding {
    scene::PixelClass pixel_class = scene::PixelClass::lit;
    scene::ClassReason reason = scene::ClassReason::none; ///< of `indeterminate`
    std::uint32_t triangle =
        scene::no_triangle; ///< the first hit, or the triangle that meets the segment
    std::uint32_t partner = scene::no_triangle; ///< the other triangle of a seam
    ContactSigns signs{};                       ///< of `triangle`, if it meets the segment
};
/// "triangle 8 crosses the segment to the light (signs: edges +++, P -, light +)".
[[nodiscard]] std::string explain(const Finding& finding);

/// Whether a pixel's witness blocks it.
struct WitnessVerdict {
    std::string fault; ///< why not; empty if it blocks
    bool is_seam = false;
};

/// Decides pixels in rational arithmetic by testing every triangle.
class BruteForce {
public:
    /// Both must outlive this object. Thread-safe.
    BruteForce(const scene::TriangleScene& scene, const scene::View& view);

    /// The class of a pixel in which GL drew `receiver` (or `no_triangle`).
    [[nodiscard]] Finding decide(int x, int y, std::uint32_t receiver) const;

    /// Whether `witness`, or the seam whose lower triangle it is, crosses the segment from the
    /// pixel's point on `receiver` to the light. Does not check whether the camera sees another
    /// triangle first.
    [[nodiscard]] WitnessVerdict check_witness(int x, int y, std::uint32_t receiver,
                                               std::uint32_t witness) const;

    /// Why a position cannot be the pixel's point on `receiver`: its distance from the exact point
    /// exceeds the error of doubles and one rounding to float32. Empty if it can.
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
    /// All triangles that the ray meets at the smallest t beyond the near plane, in order.
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
