// The list of methods of this program, in place of the library's: depth has two more bias terms.

#include "methods/list.hpp"

#include "lift.hpp"
#include "methods/depth/bias_terms.hpp"
#include "methods/depth/depth_map.hpp"
#include "methods/vsm/variance_map.hpp"
#include "pull.hpp"

#include <array>
#include <vector>

namespace gnomon::methods {
namespace {

Method depth_with_more_terms()
{
    static const std::vector<BiasTerm> terms = [] {
        std::vector<BiasTerm> all{bias_terms().begin(), bias_terms().end()};
        all.push_back(tests::pull);
        all.push_back(tests::lift);
        return all;
    }();
    Method depth = depth_map();
    depth.bias_terms = terms;
    return depth;
}

} // namespace

std::span<const Method> methods()
{
    static const std::array list{depth_with_more_terms(), variance_map()};
    return list;
}

} // namespace gnomon::methods
