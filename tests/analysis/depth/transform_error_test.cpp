#include "analysis/depth/depth_error.hpp"

#include "depth_case.hpp"

#include "scene/vec.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::analysis {
namespace {

using scene::ClipRange;
using scene::Mat4d;
using scene::Mat4f;
using scene::Projection;
using scene::Vec3d;
using scene::Vec3f;
using scene::Vec4d;
using scene::Vec4f;

/// A camera away from the world's origin with any direction; view z is −ζ.
struct Camera {
    Mat4d view{1};
    Mat4d projection{0};

    Camera(const DepthMapping& mapping, const Vec3d& eye, const Vec3d& forward)
        : view{glm::lookAt(eye, eye + forward, Vec3d{0, 1, 0})}
    {
        const scene::Vec2d row = scene::clip_depth_row(mapping.range());
        projection[0][0] = projection[1][1] = 1;
        projection[2][2] = -row.x;
        projection[3][2] = row.y;
        projection[2][3] = mapping.is_perspective() ? -1 : 0;
        projection[3][3] = mapping.is_perspective() ? 0 : 1;
    }
};

/// Row by vector, one float32 operation after the other.
Vec4f transformed(const Mat4f& m, const Vec4f& v)
{
    Vec4f result;
    for (int row = 0; row < 4; ++row) {
        float sum = m[0][row] * v[0];
        for (int column = 1; column < 4; ++column) {
            sum = sum + m[column][row] * v[column];
        }
        result[row] = sum;
    }
    return result;
}

double measured_error_m(const DepthMapping& mapping, const Camera& camera, TransformOrder order,
                        const Vec3f& vertex)
{
    const Vec4f v{vertex, 1};
    const Vec4f clip =
        order == TransformOrder::premultiplied
            ? transformed(Mat4f{camera.projection * camera.view}, v)
            : transformed(Mat4f{camera.projection}, transformed(Mat4f{camera.view}, v));
    const float z_ndc = clip.z / clip.w;
    const float depth =
        mapping.range().clip_range == ClipRange::minus_one_to_one ? 0.5F * z_ndc + 0.5F : z_ndc;
    const double light_distance_m = -(camera.view * Vec4d{v}).z;
    return mapping.light_distance_error_m(light_distance_m,
                                          double{depth} - mapping.depth(light_distance_m));
}

/// S, the sum of absolute products of the view's z row.
double row_sum_m(const Camera& camera, const Vec3f& vertex)
{
    double sum = std::abs(camera.view[3][2]);
    for (int column = 0; column < 3; ++column) {
        sum += std::abs(camera.view[column][2] * double{vertex[column]});
    }
    return sum;
}

struct Measured {
    double largest_m = 0;
    double largest_share = 0; ///< of the bound
};

Measured measure(const DepthMapping& mapping, double offset_m, TransformOrder order)
{
    std::mt19937 random{7};
    std::uniform_real_distribution<double> unit{-1, 1};
    Measured result;
    for (int i = 0; i < 4000; ++i) {
        const Vec3d forward = glm::normalize(Vec3d{unit(random), unit(random), unit(random)});
        const Vec3d eye = offset_m * Vec3d{unit(random), unit(random), unit(random)};
        const Camera camera{mapping, eye, forward};
        const double share = 0.5 * (1 + unit(random));
        const double along_m =
            mapping.near_m() + share * share * (mapping.far_m() - mapping.near_m());
        const Vec3f vertex{eye + along_m * forward};
        const double light_distance_m = -(camera.view * Vec4d{Vec4f{vertex, 1}}).z;
        if (!(light_distance_m > mapping.near_m() && light_distance_m < mapping.far_m())) {
            continue;
        }
        const double error_m = std::abs(measured_error_m(mapping, camera, order, vertex));
        result.largest_m = std::max(result.largest_m, error_m);
        result.largest_share = std::max(
            result.largest_share, error_m / transform_error_m(mapping, order, light_distance_m,
                                                              row_sum_m(camera, vertex)));
    }
    return result;
}

constexpr TransformOrder both_orders[] = {TransformOrder::view_then_projection,
                                          TransformOrder::premultiplied};

TEST(TransformError, BoundsFloat32EvaluationOfBothOrders)
{
    for (const DepthMapping& mapping : test::all_mappings()) {
        for (const double offset_m : {0.0, 1.0, 500.0}) {
            for (const TransformOrder order : both_orders) {
                const Measured measured = measure(mapping, offset_m, order);
                // The bound is first order; here it omits a relative 1e-3 at most.
                EXPECT_LE(measured.largest_share, 1.001)
                    << "offset " << offset_m << " order " << static_cast<int>(order) << " reversed "
                    << mapping.range().reversed;
                // It must not exceed the actual error by more than about ten times, or it would be
                // useless.
                EXPECT_GE(measured.largest_share, 0.05) << "offset " << offset_m;
            }
        }
    }
}

TEST(TransformError, GrowsWithLightDistanceOverNearWhenPremultiplied)
{
    const DepthMapping mapping{{Projection::perspective, 0.1, 100, false, {}}};
    const double premultiplied_m =
        transform_error_m(mapping, TransformOrder::premultiplied, 100, 1000);
    const double separate_m =
        transform_error_m(mapping, TransformOrder::view_then_projection, 100, 1000);
    // γ5·S·ζ(f − n)/(fn) against γ5·S + γ3·Aζ²/2 and the rest: 1000 against 10 and some.
    EXPECT_GT(premultiplied_m, 20 * separate_m);
    const Measured measured = measure(mapping, 500, TransformOrder::premultiplied);
    const Measured separate = measure(mapping, 500, TransformOrder::view_then_projection);
    // A prototype measured 0.089 m against 0.0077 m; other views, the same magnitudes.
    EXPECT_GT(measured.largest_m, 5 * separate.largest_m);
    EXPECT_GT(measured.largest_m, 0.03);
    EXPECT_LT(measured.largest_m, 0.3);
    EXPECT_LT(separate.largest_m, 0.02);
}

TEST(TransformError, OfReversedDepthInZeroToOneIsNotMagnified)
{
    const DepthMapping mapping{{Projection::perspective, 0.1, 100, true, ClipRange::zero_to_one}};
    // γ5(S + ζ) to first order, with the division's u·ζ(f − ζ)/f on top.
    EXPECT_NEAR(transform_error_m(mapping, TransformOrder::premultiplied, 50, 1000),
                5 * 0x1p-24 * 1050 + 0x1p-24 * 25, 1e-6);
}

TEST(TransformError, OfTheLessonAtFarIsAboutFourHalfStepsOfD24)
{
    const DepthMapping mapping{test::lesson_range()};
    // 3(f + 3n)/(f − n) = 4.04 half-steps of D24 from the projection alone; z_ndc's division adds
    // one, the viewport one, and γ5·S the rest.
    const double half_step_m = 1.7136e-5;
    const double error_m = transform_error_m(mapping, TransformOrder::view_then_projection, 50, 50);
    EXPECT_NEAR(error_m - 5 * 0x1p-24 * 50, 6.04 * half_step_m, 0.02 * half_step_m);
}

} // namespace
} // namespace gnomon::analysis
