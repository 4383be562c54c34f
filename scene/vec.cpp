#include "scene/vec.hpp"

namespace gnomon::scene {

namespace {

/// One call a component: what is not inlined cannot be vectorised away.
[[gnu::noinline]] float nearest_float32(double value)
{
    return static_cast<float>(value);
}

} // namespace

Vec3d rounded_to_float32(const Vec3d& v)
{
    return {double{nearest_float32(v.x)}, double{nearest_float32(v.y)},
            double{nearest_float32(v.z)}};
}

} // namespace gnomon::scene
