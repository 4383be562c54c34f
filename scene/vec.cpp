#include "scene/vec.hpp"

namespace gnomon::scene {

namespace {

/// One call per component: GCC cannot vectorise a call that is not inlined.
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
