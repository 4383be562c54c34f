#include "methods/depth/depth_map.hpp"
#include "methods/job_method.hpp"
#include "methods/list.hpp"

#include <array>

// Replaces methods/list.cpp with three variants of the depth method: the original, and two that
// claim to compare no depths, so that causes are found by rerunning: one with monotone verdicts,
// one without.
namespace gnomon::methods {
namespace {

LookupTraits without_comparisons(const scene::Job& job)
{
    LookupTraits promised = depth_map().traits(job);
    promised.compares = Compares::none;
    promised.curve = Curve::by_bisection;
    return promised;
}

Method rerun()
{
    Method method = depth_map();
    method.name = "depth_by_rerun";
    method.traits = without_comparisons;
    return method;
}

Method looked_up_again()
{
    Method method = depth_map();
    method.name = "depth_by_look_up";
    method.traits = [](const scene::Job& job) {
        LookupTraits promised = without_comparisons(job);
        promised.monotonicity = {Monotone::no, 0};
        promised.curve = Curve::none;
        return promised;
    };
    return method;
}

} // namespace

std::span<const Method> methods()
{
    static const std::array list{depth_map(), rerun(), looked_up_again()};
    return list;
}

} // namespace gnomon::methods
