#include "analysis/pixels/error_clusters.hpp"

#include "analysis/pixels/checks.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Takes groups of pixels out of an image, one at a time.
class GroupFinder {
public:
    explicit GroupFinder(scene::Image<std::uint8_t> is_marked) : is_left_{std::move(is_marked)} {}

    [[nodiscard]] bool is_left(std::size_t pixel) const { return is_left_[pixel] != 0; }

    /// All pixels that are connected with this one, which must be left.
    [[nodiscard]] std::vector<std::size_t> take(std::size_t first)
    {
        is_left_[first] = 0;
        std::vector<std::size_t> group{first};
        for (std::size_t next = 0; next < group.size(); ++next) {
            add_neighbours(group[next], group);
        }
        return group;
    }

private:
    void add_neighbours(std::size_t pixel, std::vector<std::size_t>& group)
    {
        const auto [width_px, height_px] = is_left_.size();
        const auto x = static_cast<int>(pixel % static_cast<std::size_t>(width_px));
        const auto y = static_cast<int>(pixel / static_cast<std::size_t>(width_px));
        for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height_px - 1); ++row) {
            for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width_px - 1);
                 ++column) {
                const std::size_t neighbour = is_left_.index(column, row);
                if (is_left(neighbour)) {
                    is_left_[neighbour] = 0;
                    group.push_back(neighbour);
                }
            }
        }
    }

    scene::Image<std::uint8_t> is_left_;
};

/// The group as a cluster; of pixels equally near to the centroid the first in reading order.
PixelCluster cluster_of(const std::vector<std::size_t>& group, int width_px)
{
    const auto width = static_cast<std::size_t>(width_px);
    const auto x_of = [&](std::size_t pixel) { return static_cast<double>(pixel % width); };
    const auto y_of = [&](std::size_t pixel) {
        const std::size_t row = pixel / width;
        return static_cast<double>(row);
    };
    double sum_x = 0;
    double sum_y = 0;
    for (const std::size_t pixel : group) {
        sum_x += x_of(pixel);
        sum_y += y_of(pixel);
    }
    const auto count = static_cast<double>(group.size());
    const std::size_t middle = std::ranges::min(group, {}, [&](std::size_t pixel) {
        const double x = x_of(pixel) - sum_x / count;
        const double y = y_of(pixel) - sum_y / count;
        return std::tuple{x * x + y * y, pixel};
    });
    return {group.size(), static_cast<int>(middle % width), static_cast<int>(middle / width)};
}

} // namespace

scene::Image<std::uint8_t> wrong_pixels(const scene::Truth& truth,
                                        const scene::LookupLayers& lookup)
{
    const scene::Image<scene::PixelClass>& classes = truth.pixel_class;
    require_equal_sizes("wrong_pixels", classes.size(), {lookup.samples.size()});
    scene::Image<std::uint8_t> is_wrong{classes.size()};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        const float verdict = lookup.samples[i].verdict;
        const bool is_error =
            scene::is_false_shadow(classes[i], verdict) || scene::is_false_lit(classes[i], verdict);
        is_wrong[i] = is_error ? 1 : 0;
    }
    return is_wrong;
}

std::optional<PixelCluster> largest_cluster(const scene::Image<std::uint8_t>& is_marked)
{
    GroupFinder groups{is_marked};
    std::vector<std::size_t> largest;
    for (std::size_t i = 0; i < is_marked.pixel_count(); ++i) {
        if (groups.is_left(i)) {
            std::vector<std::size_t> group = groups.take(i);
            if (group.size() > largest.size()) {
                largest = std::move(group);
            }
        }
    }
    if (largest.empty()) {
        return std::nullopt;
    }
    return cluster_of(largest, is_marked.size().width_px);
}

} // namespace gnomon::analysis
