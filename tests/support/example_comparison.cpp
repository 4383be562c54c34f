#include "example_comparison.hpp"

#include "analysis/sweep/compare.hpp"
#include "fake_renderers.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace gnomon::store {

namespace {

using scene::PixelClass;
using scene::Vec3d;
using Mesh = std::pair<std::vector<Vec3d>, std::vector<std::array<std::uint32_t, 3>>>;

Mesh box(const Vec3d& lower, const Vec3d& upper)
{
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i) {
        mesh.first.emplace_back((i & 1U) != 0 ? upper.x : lower.x,
                                (i & 2U) != 0 ? upper.y : lower.y,
                                (i & 4U) != 0 ? upper.z : lower.z);
    }
    mesh.second = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

Mesh sphere(const Vec3d& centre, double radius_m, int segments)
{
    Mesh mesh;
    const int rings = segments / 2;
    const auto index = [&](int ring, int segment) {
        return static_cast<std::uint32_t>(ring * segments + segment % segments);
    };
    for (int ring = 0; ring <= rings; ++ring) {
        const double theta = std::numbers::pi * ring / rings;
        for (int segment = 0; segment < segments; ++segment) {
            const double phi = 2 * std::numbers::pi * segment / segments;
            mesh.first.push_back(centre + radius_m * Vec3d{std::sin(theta) * std::cos(phi),
                                                           std::cos(theta),
                                                           std::sin(theta) * std::sin(phi)});
            if (ring < rings) {
                mesh.second.push_back(
                    {index(ring, segment), index(ring, segment + 1), index(ring + 1, segment)});
                mesh.second.push_back({index(ring, segment + 1), index(ring + 1, segment + 1),
                                       index(ring + 1, segment)});
            }
        }
    }
    return mesh;
}

scene::SceneFile example_scene(const ExampleOptions& options)
{
    scene::SceneBuilder builder;
    const auto add = [&](std::string_view name, const Mesh& mesh) {
        builder.add(name, mesh.first, mesh.second);
    };
    add("ground", {{{-5, 0, -5}, {5, 0, -5}, {-5, 0, 5}, {5, 0, 5}}, {{0, 2, 1}, {1, 2, 3}}});
    add("box", box({-1.6, 0, -0.8}, {-0.4, 1.5, 0.4}));
    add("sphere", sphere({1.1, 0.9, 0.2}, 0.9, options.sphere_segments));
    return {builder.take(), {}};
}

scene::Job example_job(const ExampleOptions& options)
{
    scene::Job job;
    job.scene.file = "models/example.obj";
    job.image = options.image;
    job.camera = scene::CameraSettings{};
    job.camera->eye = {2.5, 3.2, 5.5};
    job.camera->target = {-0.3, 0.5, 0};
    job.light = scene::LightSettings{};
    job.light->direction = Vec3d{-0.8, -1, -0.35};
    job.shadow_map.resolution_texels = options.resolution_texels;
    job.bias.constant = options.bias_constant;
    return job;
}

/// The ray's parameter at the triangle, or infinity (Möller and Trumbore).
double hit(const scene::TriangleScene& scene, std::uint32_t triangle, const scene::Ray& ray)
{
    constexpr double miss = std::numeric_limits<double>::infinity();
    const auto [af, bf, cf] = scene.corners(triangle);
    const Vec3d a{af};
    const Vec3d ab = Vec3d{bf} - a;
    const Vec3d ac = Vec3d{cf} - a;
    const Vec3d p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) {
        return miss;
    }
    const Vec3d s = ray.origin - a;
    const double u = glm::dot(s, p) / determinant;
    const Vec3d q = glm::cross(s, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    return (u < 0 || v < 0 || u + v > 1 || t < 1e-6) ? miss : t;
}

struct Hit {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = scene::no_triangle;
};

Hit first_hit(const scene::TriangleScene& scene, const scene::Ray& ray,
              std::uint32_t except = scene::no_triangle)
{
    Hit nearest;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const double distance = i == except ? nearest.distance : hit(scene, i, ray);
        if (distance < nearest.distance) {
            nearest = {distance, i};
        }
    }
    return nearest;
}

/// Renders by rays alone.
class RayRenderers {
public:
    RayRenderers(const scene::TriangleScene& scene, scene::Image<scene::Vec3f>& points)
        : scene_{scene},
          points_{points}
    {
    }

    scene::ReceiverLayers draw_receivers(const scene::View& view)
    {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        receivers_ = scene::Image<std::uint32_t>{view.image, scene::no_triangle};
        points_ = scene::Image<scene::Vec3f>{view.image, scene::Vec3f{nan}};
        for_each_pixel(view.image, [&](int x, int y) {
            const scene::Ray ray = scene::pixel_ray(view.camera, view.image, x, y);
            const Hit seen = first_hit(scene_, ray);
            receivers_(x, y) = seen.triangle;
            if (seen.triangle != scene::no_triangle) {
                points_(x, y) = scene::Vec3f{ray.origin + seen.distance * ray.direction};
            }
        });
        return {receivers_};
    }

    scene::LookupLayers look_up(const scene::Job& job, const scene::View& view) const
    {
        scene::LookupLayers layers{scene::Image<scene::LookupSample>{view.image}};
        for_each_pixel(view.image, [&](int x, int y) {
            if (receivers_(x, y) != scene::no_triangle) {
                layers.samples(x, y) = sample(job, view, Vec3d{points_(x, y)});
            }
        });
        return layers;
    }

    scene::Truth find_truth(const scene::View& view) const
    {
        scene::Truth truth;
        truth.pixel_class = scene::Image<PixelClass>{view.image};
        truth.reason = scene::Image<scene::ClassReason>{view.image};
        truth.witness = scene::Image<std::uint32_t>{view.image, scene::no_triangle};
        for_each_pixel(view.image, [&](int x, int y) { classify(truth, view, x, y); });
        return truth;
    }

private:
    template <typename Function>
    static void for_each_pixel(scene::ImageSize size, const Function& function)
    {
        for (int y = 0; y < size.height_px; ++y) {
            for (int x = 0; x < size.width_px; ++x) {
                function(x, y);
            }
        }
    }

    /// A nearest lookup: compares the receiver's depth with that at the texel's centre.
    scene::LookupSample sample(const scene::Job& job, const scene::View& view,
                               const Vec3d& point) const
    {
        const scene::LightFrustum& frustum = view.first_map();
        const double texel_m =
            (frustum.right_side - frustum.left) / job.shadow_map.resolution_texels;
        const auto centre = [&](double offset_m) {
            return (std::floor(offset_m / texel_m) + 0.5) * texel_m;
        };
        const Vec3d offset = point - frustum.origin;
        const Vec3d texel = frustum.origin +
                            centre(glm::dot(offset, frustum.right)) * frustum.right +
                            centre(glm::dot(offset, frustum.up)) * frustum.up;
        constexpr double back_m = 100;
        const Hit seen = first_hit(scene_, {texel - back_m * frustum.forward, frustum.forward});
        const auto depth = [&](double light_distance_m) {
            return static_cast<float>((light_distance_m - frustum.near_m) / frustum.range_m());
        };
        scene::LookupSample result;
        result.receiver_depth = depth(frustum.light_distance_m(point));
        result.map_depth =
            seen.triangle == scene::no_triangle ? 1.0F : depth(seen.distance - back_m);
        result.verdict =
            result.receiver_depth - view.bias.constant <= result.map_depth ? 1.0F : 0.0F;
        return result;
    }

    void classify(scene::Truth& truth, const scene::View& view, int x, int y) const
    {
        const std::uint32_t receiver = receivers_(x, y);
        if (receiver == scene::no_triangle) {
            return;
        }
        const auto [a, b, c] = scene_.corners(receiver);
        const Vec3d normal = glm::cross(Vec3d{b} - Vec3d{a}, Vec3d{c} - Vec3d{a});
        const Vec3d to_light = -view.light.direction;
        const Vec3d ray = scene::pixel_ray(view.camera, view.image, x, y).direction;
        if (glm::dot(normal, to_light) * glm::dot(normal, -ray) <= 0) {
            truth.pixel_class(x, y) = PixelClass::attached;
            return;
        }
        const Hit blocker = first_hit(scene_, {Vec3d{points_(x, y)}, to_light}, receiver);
        truth.pixel_class(x, y) =
            blocker.triangle == scene::no_triangle ? PixelClass::lit : PixelClass::blocked;
        truth.witness(x, y) = blocker.triangle;
    }

    const scene::TriangleScene& scene_;
    scene::Image<scene::Vec3f>& points_;
    scene::Image<std::uint32_t> receivers_;
};

/// Adds a column of each class that rays in double precision never give, if the image is wide
/// enough.
scene::Truth with_rare_classes(scene::Truth truth)
{
    constexpr int unmatched_x = 2;
    constexpr int indeterminate_x = 4;
    const scene::ImageSize size = truth.pixel_class.size();
    if (size.width_px <= indeterminate_x) {
        return truth;
    }
    for (int y = size.height_px / 2; y < size.height_px; y += 3) {
        truth.pixel_class(unmatched_x, y) = PixelClass::unmatched;
        truth.reason(unmatched_x, y) = scene::ClassReason::snap;
        truth.pixel_class(indeterminate_x, y) = PixelClass::indeterminate;
        truth.reason(indeterminate_x, y) = scene::ClassReason::silhouette;
        truth.witness(unmatched_x, y) = scene::no_triangle;
        truth.witness(indeterminate_x, y) = scene::no_triangle;
    }
    return truth;
}

} // namespace

Example::Example(const ExampleOptions& options) : file{example_scene(options)}
{
    RayRenderers rays{file.scene, points};
    tests::FakeRenderers fake;
    fake.rasterizer.on_receivers = [&](const scene::View& view) {
        return rays.draw_receivers(view);
    };
    fake.rasterizer.on_look_up = [&](const scene::Job& job, const scene::View& view) {
        return rays.look_up(job, view);
    };
    fake.reference.on_truth = [&](const scene::View& view, const scene::ReceiverLayers&) {
        return with_rare_classes(rays.find_truth(view));
    };
    fake.environment = {"brute-force rays", "4.5 (example)", "Embree 3.13.5", "Gnomon 0.1.0"};
    comparison = analysis::compare(example_job(options), file, fake.renderers());
}

const Example& example()
{
    static const Example instance;
    return instance;
}

} // namespace gnomon::store
