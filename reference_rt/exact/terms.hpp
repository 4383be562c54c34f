#pragma once

#include "reference_rt/exact/arithmetic.hpp"
#include "reference_rt/exact/receiver.hpp"
#include "scene/light/light.hpp"
#include "scene/vec.hpp"

#include <utility>

/// The terms of the predicates' formulas, for any arithmetic.
namespace gnomon::reference_rt {

/// δ and ν of a receiver on a ray.
template <typename Delta, typename Nu>
struct PlaneHit {
    Delta delta;
    Nu nu;
};
inline auto plane_hit(FilterField, const Receiver& receiver)
{
    return PlaneHit<Filtered<7>, Filtered<8>>{receiver.delta, receiver.nu};
}
template <typename Field>
auto plane_hit(Field, const Receiver& receiver)
{
    const scene::Ray& ray = receiver.ray();
    const auto normal = normal_of<Field>(receiver.corners());
    auto delta = dot(normal, vector<Field>(ray.direction));
    auto nu = dot(normal, difference<Field>(receiver.corners()[0], ray.origin));
    return PlaneHit<decltype(delta), decltype(nu)>{std::move(delta), std::move(nu)};
}

inline Vec3<Filtered<1>> negated(const Vec3<Filtered<0>>& v)
{
    return {Filtered<0>{-v.x.value, v.x.permanent}, Filtered<0>{-v.y.value, v.y.permanent},
            Filtered<0>{-v.z.value, v.z.permanent}};
}
inline Vec3<Dyadic> negated(const Vec3<Dyadic>& v)
{
    const Dyadic zero;
    return {zero - v.x, zero - v.y, zero - v.z};
}

/// g(x): the vector from x to the light.
template <typename Field>
auto towards(const scene::Light& light, const scene::Vec3d& x)
{
    return light.has_position()
               ? decltype(negated(vector<Field>(x))){difference<Field>(light.position, x)}
               : negated(vector<Field>(light.direction));
}

/// δ row·(P, 1)
template <typename Field, typename Number>
Number scaled_row(Field /*field*/, const scene::Vec4d& row, const scene::Ray& ray,
                  const PlaneHit<Number, Number>& plane)
{
    const auto axis = vector<Field>(scene::Vec3d{row});
    return plane.delta * (dot(axis, vector<Field>(ray.origin)) + Field::number(row.w)) +
           plane.nu * dot(axis, vector<Field>(ray.direction));
}

/// δ row·(P + offset, 1)
template <typename Field, typename Number>
Number scaled_row(Field field, const scene::Vec4d& row, const scene::Ray& ray,
                  const PlaneHit<Number, Number>& plane, const scene::Vec3d& offset)
{
    if (offset == scene::Vec3d{0.0}) {
        return scaled_row(field, row, ray, plane);
    }
    const auto axis = vector<Field>(scene::Vec3d{row});
    return scaled_row(field, row, ray, plane) + plane.delta * dot(axis, vector<Field>(offset));
}

/// δ N·(P − o): the sign of N·(P − o), times that of δ.
template <typename Field, typename Normal>
auto scaled_side(Field field, const Receiver& receiver, const Normal& normal, const scene::Vec3d& o)
{
    const auto of_ray = [&] {
        const scene::Ray& ray = receiver.ray();
        const auto [delta, nu] = plane_hit(field, receiver);
        return delta * dot(normal, difference<Field>(ray.origin, o)) +
               nu * dot(normal, vector<Field>(ray.direction));
    };
    using Side = decltype(of_ray());
    if (receiver.place == nullptr) {
        return of_ray();
    }
    const auto& [a, b, c] = receiver.corners();
    return Side{dot(normal, difference<Field>(a, o)) +
                Field::number(receiver.place->u) * dot(normal, difference<Field>(b, a)) +
                Field::number(receiver.place->v) * dot(normal, difference<Field>(c, a))};
}

/// δ(P − o)
template <typename Field>
auto scaled_offset(Field field, const Receiver& receiver, const scene::Vec3d& o)
{
    const auto of_ray = [&] {
        const scene::Ray& ray = receiver.ray();
        const auto [delta, nu] = plane_hit(field, receiver);
        return delta * difference<Field>(ray.origin, o) + nu * vector<Field>(ray.direction);
    };
    using Offset = decltype(of_ray());
    if (receiver.place == nullptr) {
        return of_ray();
    }
    const auto& [a, b, c] = receiver.corners();
    const auto offset = difference<Field>(a, o) +
                        Field::number(receiver.place->u) * difference<Field>(b, a) +
                        Field::number(receiver.place->v) * difference<Field>(c, a);
    return Offset{offset.x, offset.y, offset.z};
}

} // namespace gnomon::reference_rt
