#include "methods/depth/depth_map.hpp"
#include "methods/list.hpp"

#include <array>

// The depth method twice: as it is, and as if it compared no depths, so that its causes are found
// by running it again. This takes the place of methods/list.cpp.
namespace gnomon::methods {
namespace {

Method rerun()
{
    Method method = depth_map();
    method.name = "depth_by_rerun";
    method.promises = [](const scene::Job& job) {
        Promises promised = depth_map().promises(job);
        promised.compares = Compares::none;
        promised.curve = Curve::by_bisection;
        return promised;
    };
    return method;
}

} // namespace

std::span<const Method> methods()
{
    static const std::array list{depth_map(), rerun()};
    return list;
}

} // namespace gnomon::methods
