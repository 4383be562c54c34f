#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/terms.hpp"
#include "reference_rt/exact/triangle_contact.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <deque>
#include <random>

namespace gnomon::reference_rt {
namespace {

using scene::Light;
using scene::LightType;
using scene::Ray;
using scene::Vec3d;

const ExactTriangle ground{{0, {Vec3d{-4, 0, -4}, Vec3d{-4, 0, 4}, Vec3d{4, 0, 0}}}};

Receiver make_receiver(const ExactTriangle& face, const Ray& ray)
{
    static std::deque<CameraRay> rays; // which receivers point to
    SignCounts counts;
    return Receiver{face, rays.emplace_back(ray), counts};
}

/// P = (x, 0, z), seen from 4 above it; the coordinates are short binary fractions, so every
/// operation in the signs is exact.
Receiver receiver_at(double x, double z)
{
    return make_receiver(ground, Ray{Vec3d{x, 4, z}, Vec3d{0, -1, 0}});
}

Light directional(const Vec3d& direction)
{
    Light light;
    light.direction = direction;
    return light;
}

Light positional(const Vec3d& position, const Vec3d& axis, double cosine)
{
    Light light;
    light.type = LightType::spot;
    light.position = position;
    light.direction = axis;
    light.cos_half_cone = cosine;
    return light;
}

Contact contact(const Receiver& receiver, const Corners& s, const Light& light)
{
    SignCounts counts;
    const Contact signs = classify_contact(shadow_signs(receiver, s, light, counts));
    const bool passes_by = signs == Contact::plane && !runs_through(receiver, s, light);
    EXPECT_EQ(find_contact(receiver, {1, s}, light, counts).kind,
              passes_by ? Contact::none : signs);
    return signs;
}

TEST(MakeReceiver, PutsThePointOnThePlane)
{
    EXPECT_EQ(receiver_at(0.5, 0.25).point(), (Vec3d{0.5, 0, 0.25}));
}

TEST(ShadowSigns, FindACrossingAboveThePointForBothLightsAndBothWindings)
{
    const Corners roof{Vec3d{-1, 1, -1}, Vec3d{1, 1, -1}, Vec3d{0, 1, 1}};
    const Corners turned{roof[0], roof[2], roof[1]};
    for (const Light& light : {directional({0, -1, 0}), positional({0, 2, 0}, {0, -1, 0}, 0.5)}) {
        EXPECT_EQ(contact(receiver_at(0.125, 0), roof, light), Contact::cross);
        EXPECT_EQ(contact(receiver_at(0.125, 0), turned, light), Contact::cross);
        EXPECT_EQ(contact(receiver_at(3, 0), roof, light), Contact::none);
    }
    // Beyond the light nothing blocks.
    EXPECT_EQ(contact(receiver_at(0.125, 0), roof, positional({0, 0.5, 0}, {0, -1, 0}, 0.5)),
              Contact::none);
}

TEST(ShadowSigns, SeeContactsNearerThanAnyRayEpsilon)
{
    // A roof 2^-40 above the ground: far below the rounding of any float ray.
    const double h = 0x1p-40;
    const Corners roof{Vec3d{-1, h, -1}, Vec3d{1, h, -1}, Vec3d{0, h, 1}};
    EXPECT_EQ(contact(receiver_at(0.125, 0), roof, directional({0, -1, 0})), Contact::cross);
}

TEST(ShadowSigns, NeverCallACoplanarTriangleABlocker)
{
    const Corners overlap{Vec3d{-1, 0, -1}, Vec3d{1, 0, -1}, Vec3d{0, 0, 1}};
    const Receiver skewed =
        make_receiver(ground, Ray{Vec3d{0.1, 3.7, 0.3}, Vec3d{0.013, -0.97, -0.11}});
    SignCounts counts;
    EXPECT_EQ(shadow_signs(skewed, overlap, directional({0.3, -1, 0.2}), counts).point, 0);
    EXPECT_EQ(contact(skewed, overlap, directional({0.3, -1, 0.2})), Contact::none);
}

TEST(ShadowSigns, TellExactEdgeVertexAndPlaneContacts)
{
    const Corners roof{Vec3d{-1, 1, -1}, Vec3d{1, 1, -1}, Vec3d{0, 1, 1}};
    EXPECT_EQ(contact(receiver_at(0.5, -1), roof, directional({0, -1, 0})), Contact::edge);
    EXPECT_EQ(contact(receiver_at(1, -1), roof, directional({0, -1, 0})), Contact::vertex);
    const Corners wall{Vec3d{0.5, 0, -1}, Vec3d{0.5, 1, -1}, Vec3d{0.5, 0, 1}};
    EXPECT_EQ(contact(receiver_at(0.5, 0), wall, directional({0, -1, 0})), Contact::plane);
}

TEST(ShadowSigns, OfASharedEdgeAreOpposite)
{
    // The edge (a, b) of two triangles, met by rays that no arithmetic of 53 bits resolves.
    const Vec3d a{0.1F, 1, 0.7F};
    const Vec3d b{0.9F, 1, 0.2F};
    const Corners left{a, b, Vec3d{0, 1.5, 0}};
    const Corners right{b, a, Vec3d{1, 0.5, 1}};
    for (const Light& light :
         {directional({0.3F, -1, 0.1F}), positional({0.2F, 3, 0.9F}, {0, -1, 0}, 0.5)}) {
        for (int i = 0; i < 100; ++i) {
            const Ray ray{Vec3d{0.3, 5, 0.2}, Vec3d{0.01 * i + 0.003, -1.7, 0.013 * i}};
            const Receiver receiver = make_receiver(ground, ray);
            SignCounts counts;
            EXPECT_EQ(shadow_signs(receiver, left, light, counts).edge[0],
                      -shadow_signs(receiver, right, light, counts).edge[0])
                << "i = " << i;
        }
    }
}

TEST(ApexSide, TellsASeamFromAFold)
{
    const Vec3d u{0, 1, -1};
    const Vec3d v{0, 1, 1};
    SignCounts counts;
    for (const Light& light : {directional({0, -1, 0}), positional({0, 5, 0}, {0, -1, 0}, 0.5)}) {
        const Sign left = apex_side(light, u, v, {-1, 1, 0}, counts);
        EXPECT_TRUE(is_seam(left, apex_side(light, u, v, {1, 0.5, 0}, counts)));
        EXPECT_FALSE(is_seam(left, apex_side(light, u, v, {-1, 0.5, 0}, counts)));
        EXPECT_FALSE(is_seam(left, apex_side(light, u, v, {0, 0, 0.5}, counts)));
    }
}

TEST(RunsThrough, NeedsTheOpenSegmentToMeetTheTriangle)
{
    const Corners wall{Vec3d{0.5, 1, -1}, Vec3d{0.5, 2, 0}, Vec3d{0.5, 1, 1}};
    EXPECT_TRUE(runs_through(receiver_at(0.5, 0), wall, directional({0, -1, 0})));
    EXPECT_TRUE(runs_through(receiver_at(0.5, 1), wall, directional({0, -1, 0}))); // at a corner
    EXPECT_FALSE(runs_through(receiver_at(0.5, 2), wall, directional({0, -1, 0})));
    EXPECT_FALSE(
        runs_through(receiver_at(0.5, 0), wall, positional({0.5, 0.5, 0}, {0, -1, 0}, 0.5)));
    EXPECT_FALSE(runs_through(receiver_at(0.5, 0), wall, directional({0, 1, 0})));
    const Corners foot{Vec3d{0.5, 0, 0}, Vec3d{0.5, -1, 1}, Vec3d{0.5, -1, -1}};
    EXPECT_FALSE(runs_through(receiver_at(0.5, 0), foot, directional({0, -1, 0}))); // at P only
}

TEST(IsAttached, HoldsBehindAndInThePlane)
{
    SignCounts counts;
    const Receiver receiver = receiver_at(0, 0);
    const auto attached_by = [&](const Light& light) {
        return is_attached(receiver, light_side(receiver.corners(), light, counts));
    };
    EXPECT_FALSE(attached_by(directional({0, -1, 0})));
    EXPECT_TRUE(attached_by(directional({0, 1, 0})));
    EXPECT_TRUE(attached_by(directional({1, 0, 0.5})));
    EXPECT_FALSE(attached_by(positional({0, 1, 0}, {0, -1, 0}, 0.5)));
    EXPECT_TRUE(attached_by(positional({3, 0, 0}, {-1, 0, 0}, 0.5)));
}

TEST(IsOutOfLight, FollowsTheConeAndItsSide)
{
    SignCounts counts;
    const Light light = positional({0, 2, 0}, {0, -1, 0}, 0.5);
    EXPECT_FALSE(is_out_of_light(receiver_at(0, 0), light, counts));
    // cos = 1/2 from height 2: the border's radius is 2·sqrt 3 = 3.4641016…
    EXPECT_FALSE(is_out_of_light(receiver_at(3.464101, 0), light, counts));
    EXPECT_TRUE(is_out_of_light(receiver_at(3.464102, 0), light, counts));
    EXPECT_TRUE(is_out_of_light(receiver_at(0, 0), positional({0, 2, 0}, {0, 1, 0}, 0.5),
                                counts)); // behind
    EXPECT_FALSE(is_out_of_light(receiver_at(100, 0), directional({0, -1, 0}), counts));
}

TEST(HitOf, IsOfAClosedTriangle)
{
    SignCounts counts;
    const SceneTriangle triangle{0, {Vec3d{0, 0, -2}, Vec3d{1, 0, -2}, Vec3d{0, 1, -2}}};
    const auto hit = [&](const Vec3d& from, const Vec3d& direction) {
        return hit_of(CameraRay{Ray{from, direction}}, triangle, counts);
    };
    EXPECT_EQ(hit({0.25, 0.25, 0}, {0, 0, -1}).kind, Contact::cross);
    const TriangleContact on_edge = hit({0.5, 0.5, 0}, {0, 0, -1});
    EXPECT_EQ(on_edge.kind, Contact::edge);
    EXPECT_EQ(on_edge.edge, 1);
    EXPECT_EQ(hit({0, 0, 0}, {0, 0, -1}).kind, Contact::vertex);
    EXPECT_EQ(hit({0.5, 0.75, 0}, {0, 0, -1}).kind, Contact::none);
    EXPECT_EQ(hit({1.5, 0, 0}, {0, 0, -1}).kind, Contact::none); // beyond an edge's end
    EXPECT_EQ(hit({0, 0, -2}, {1, 0, 0}).kind, Contact::none);   // in its plane
}

TEST(ExactOffset, IsBitForBitWhatIntegersGive)
{
    constexpr unsigned seed = 13;
    std::mt19937 random{seed};
    std::uniform_real_distribution<float> place{-8, 8};
    const auto point = [&] { return Vec3d{place(random), place(random), place(random)}; };
    for (int run = 0; run < 20'000; ++run) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run);
        Corners corners{point(), point(), point()};
        const int level = run % 4; // the axis that the plane faces; 3: none
        if (level < 3) {
            corners[1][level] = corners[0][level];
            corners[2][level] = corners[0][level];
        }
        const ExactTriangle face{{0, corners}};
        const CameraRay ray{{point(), point()}};
        SignCounts counts;
        const Receiver receiver{face, ray, counts};
        if (receiver.delta_sign == 0) {
            continue;
        }
        const Vec3d origin = run % 3 == 0 ? Vec3d{0.0} : point();
        const auto [delta, nu] = plane_hit(ExactField{}, receiver);
        const Vec3d offset = exact_offset(receiver, origin);
        for (int k = 0; k < 3; ++k) {
            const Dyadic part = delta * ExactField::difference(ray.ray.origin[k], origin[k]) +
                                nu * ExactField::number(ray.ray.direction[k]);
            EXPECT_EQ(std::bit_cast<std::uint64_t>(offset[k]),
                      std::bit_cast<std::uint64_t>(Dyadic::quotient(part, delta)))
                << "axis " << k;
        }
    }
}

} // namespace
} // namespace gnomon::reference_rt
