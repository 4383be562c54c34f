#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::analysis {

/// Positions of the receivers, in double. Used for bins and units, never for verdicts.
class ReceiverGeometry {
public:
    /// The arguments must outlive this.
    ReceiverGeometry(const scene::TriangleScene& scene, const scene::View& view,
                     const scene::Image<std::uint32_t>& receivers)
        : scene_{scene},
          view_{view},
          receivers_{receivers}
    {
    }

    /// P, the pixel-centre ray ∩ plane(T) [m]. Precondition: the pixel has a receiver.
    [[nodiscard]] scene::Vec3d point(std::size_t pixel) const;
    /// Light distance of P [m].
    [[nodiscard]] double light_distance_m(std::size_t pixel) const
    {
        return view_.light_distance_m(point(pixel));
    }
    /// Width of the pixel at P, across the view [m].
    [[nodiscard]] double footprint_m(std::size_t pixel) const;

private:
    struct Hit {
        scene::Ray ray;
        double t;
    };
    [[nodiscard]] Hit hit(std::size_t pixel) const;

    const scene::TriangleScene& scene_;
    const scene::View& view_;
    const scene::Image<std::uint32_t>& receivers_;
};

/// Light distance of the scored receivers [m]; NaN elsewhere.
[[nodiscard]] scene::Image<float> light_distances_m(const scene::Image<scene::PixelClass>& classes,
                                                    const ReceiverGeometry& geometry);

} // namespace gnomon::analysis
