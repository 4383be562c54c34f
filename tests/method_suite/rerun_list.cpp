#include "methods/depth/depth_map.hpp"
#include "methods/job_method.hpp"
#include "methods/list.hpp"

#include <array>

// The depth method three times: as it is, and as if it compared no depths, so that its causes are
// found by running it again: with verdicts that rise with the bias, and as if they did not. This
// takes the place of methods/list.cpp.
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
