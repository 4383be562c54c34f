#include "reference_rt/pixels/corner_fans.hpp"

#include <tbb/parallel_sort.h>

#include <numeric>
#include <tuple>

namespace gnomon::reference_rt {

namespace {

/// Numbers the distinct vertex positions; returns their count.
std::uint32_t number_positions(const std::vector<scene::Vec3f>& vertices,
                               std::vector<std::uint32_t>& position_of)
{
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    tbb::parallel_sort(order, [&](std::uint32_t i, std::uint32_t k) {
        const scene::Vec3f& a = vertices[i];
        const scene::Vec3f& b = vertices[k];
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    position_of.resize(vertices.size());
    std::uint32_t position = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        position += i > 0 && vertices[order[i]] != vertices[order[i - 1]] ? 1U : 0U;
        position_of[order[i]] = position;
    }
    return order.empty() ? 0 : position + 1;
}

} // namespace

CornerFans::CornerFans(const scene::TriangleScene& scene) : scene_{scene}
{
    first_.resize(number_positions(scene.vertices, position_of_) + std::size_t{1});
    for (const auto& triangle : scene.triangles) {
        for (const std::uint32_t vertex : triangle) {
            ++first_[position_of_[vertex] + std::size_t{1}];
        }
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    members_.resize(first_.back());
    std::vector<std::size_t> next{first_.begin(), first_.end() - 1};
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        for (const std::uint32_t vertex : scene.triangles[i]) {
            members_[next[position_of_[vertex]]++] = i;
        }
    }
}

} // namespace gnomon::reference_rt
