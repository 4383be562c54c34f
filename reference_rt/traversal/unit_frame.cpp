#include "reference_rt/traversal/unit_frame.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

double power_of_two(int exponent)
{
    return std::ldexp(1.0, exponent);
}

} // namespace

UnitFrame::UnitFrame(const scene::Box& box) : centre_{scene::Vec3f{box.centre()}}
{
    const double reach = std::max(largest(box.upper - centre_), largest(box.lower - centre_));
    scale_ = power_of_two(-(std::ilogb(reach) + 1));
}

Vec3d normalised(const Vec3d& v)
{
    return power_of_two(-std::ilogb(largest(v))) * v;
}

} // namespace gnomon::reference_rt
