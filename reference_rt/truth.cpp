#include "reference_rt/truth.hpp"

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/classify.hpp"
#include "reference_rt/traversal/embree_scene.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <limits>
#include <stdexcept>

namespace gnomon::reference_rt {

using scene::Image;
using scene::ImageSize;
using scene::no_triangle;
using scene::Truth;
using scene::Vec3f;
using scene::View;

namespace {

void check_receivers(const Image<std::uint32_t>& receivers, ImageSize image,
                     std::size_t triangle_count, const char* function)
{
    if (receivers.size() != image) {
        throw std::invalid_argument{fmt::format(
            "{}: receivers are {}x{} pixels, the view {}x{}", function, receivers.size().width_px,
            receivers.size().height_px, image.width_px, image.height_px)};
    }
    for (const std::uint32_t triangle : receivers) {
        if (triangle != no_triangle && triangle >= triangle_count) {
            throw std::invalid_argument{fmt::format("{}: receiver {} of a scene of {} triangles",
                                                    function, triangle, triangle_count)};
        }
    }
}

void check_method(const ReferenceScene::Implementation& reference, TruthMethod method)
{
    if (!(method == TruthMethod::exact ? reference.padded : reference.native)) {
        throw std::invalid_argument{
            "compute_truth: the reference was built without the hierarchy of this method"};
    }
}

} // namespace

Truth compute_truth(const ReferenceScene& reference, const View& view,
                    const Image<std::uint32_t>& receivers, const renderers::RasterFacts& raster,
                    const TruthOptions& options)
{
    const ReferenceScene::Implementation& implementation = reference.implementation();
    check_receivers(receivers, view.image, implementation.triangles.triangles.size(),
                    "compute_truth");
    check_method(implementation, options.method);
    Truth layers = options.method == TruthMethod::exact
                       ? classify_exactly(implementation, view, receivers, raster, options.threads)
                       : classify_by_plain_rays(implementation, view, receivers, options.threads);
    implementation.errors.check("compute_truth");
    return layers;
}

Image<Vec3f> receiver_points(const scene::TriangleScene& triangles, const View& view,
                             const Image<std::uint32_t>& receivers)
{
    check_receivers(receivers, view.image, triangles.triangles.size(), "receiver_points");
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Image<Vec3f> points{view.image, Vec3f{nan}};
    tbb::parallel_for(0, view.image.height_px, [&](int y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            const std::uint32_t triangle = receivers(x, y);
            if (triangle != no_triangle) {
                SignCounts ignored; // only points are needed
                const CameraRay ray{pixel_ray(view.camera, view.image, x, y)};
                const ExactTriangle face{triangles, triangle};
                points(x, y) = Vec3f{Receiver{face, ray, ignored}.point()};
            }
        }
    });
    return points;
}

std::string embree_version()
{
    return fmt::format("Embree {}", RTC_VERSION_STRING);
}

} // namespace gnomon::reference_rt
