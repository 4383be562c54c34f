#include "analysis/pixels/receiver_geometry.hpp"

#include "analysis/pixels/pixel_runs.hpp"

#include <glm/geometric.hpp>

#include <limits>

namespace gnomon::analysis {

using scene::Vec3d;

ReceiverGeometry::Hit ReceiverGeometry::hit(std::size_t pixel) const
{
    const auto width = static_cast<std::size_t>(view_.image.width_px);
    const scene::Ray ray = pixel_ray(view_.camera, view_.image, static_cast<int>(pixel % width),
                                     static_cast<int>(pixel / width));
    const auto corners = scene_.corners(receivers_[pixel]);
    const Vec3d a{corners[0]};
    const Vec3d normal = glm::cross(Vec3d{corners[1]} - a, Vec3d{corners[2]} - a);
    return {ray, glm::dot(normal, a - ray.origin) / glm::dot(normal, ray.direction)};
}

Vec3d ReceiverGeometry::point(std::size_t pixel) const
{
    const auto [ray, t] = hit(pixel);
    return ray.origin + t * ray.direction;
}

double ReceiverGeometry::footprint_m(std::size_t pixel) const
{
    const double at_unit_distance = 2 * view_.camera.half_height / view_.image.height_px;
    // The ray's direction advances by 1 along the view, so t is the depth.
    return view_.camera.projection == scene::Projection::perspective
               ? at_unit_distance * hit(pixel).t
               : at_unit_distance;
}

scene::Image<float> light_distances_m(const scene::Image<scene::PixelClass>& classes,
                                      const ReceiverGeometry& geometry)
{
    scene::Image<float> light_distance_m{classes.size(), std::numeric_limits<float>::quiet_NaN()};
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            if (scene::is_scored(classes[i])) {
                light_distance_m[i] = static_cast<float>(geometry.light_distance_m(i));
            }
        }
    });
    return light_distance_m;
}

} // namespace gnomon::analysis
