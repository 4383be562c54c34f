#include "methods/list.hpp"

#include "methods/depth/depth_map.hpp"

#include <algorithm>
#include <array>

namespace gnomon::methods {

std::span<const Method> methods()
{
    static const std::array list{depth_map()};
    return list;
}

const Method* find_method(std::string_view name)
{
    const auto all = methods();
    const auto found = std::ranges::find(all, name, &Method::name);
    return found == all.end() ? nullptr : &*found;
}

Promises promises(const scene::Job& job)
{
    return methods().front().promises(job); // a job cannot name another yet
}

} // namespace gnomon::methods
