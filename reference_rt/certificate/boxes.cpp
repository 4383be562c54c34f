#include "reference_rt/certificate/boxes.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt::certificate {

using scene::Vec3d;

namespace {

constexpr double unit_roundoff = 0x1p-53;
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A point in doubles, with an error bound for each coordinate.
struct Enclosure {
    Vec3d centre{0};
    double radius = 0;
};

double largest_of(const Vec3d& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Encloses a finite point. The radius is checked exactly; it is infinite if the check fails.
Enclosure enclose(const Point& point)
{
    const double weight = point.weight.rounded();
    const std::array<const Rational*, 3> numerators{&point.vector.x, &point.vector.y,
                                                    &point.vector.z};
    Enclosure result;
    for (int axis = 0; axis < 3; ++axis) {
        result.centre[axis] = numerators[static_cast<std::size_t>(axis)]->rounded() / weight;
    }
    // Two conversions and a quotient round by a few ulp; the smallest normal covers underflow.
    result.radius = 16 * unit_roundoff * largest_of(result.centre) + 0x1p-1022;
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(result.centre[axis]) ||
            !is_within(*numerators[static_cast<std::size_t>(axis)], point.weight,
                       result.centre[axis], result.radius)) {
            return {Vec3d{0}, unbounded};
        }
    }
    return result;
}

Vec3d rounded(const Vector& v)
{
    return {v.x.rounded(), v.y.rounded(), v.z.rounded()};
}

} // namespace

SegmentBounds::SegmentBounds(const Point& start, const Point& end, double largest_m)
{
    const Enclosure from = enclose(start);
    start_ = from.centre;
    // M bounds every coordinate below, r the start's error, q the direction's.
    double m = std::max(largest_m, largest_of(start_));
    const double r = from.radius;
    double q = 0;
    if (end.weight.sign() == 0) {
        direction_ = rounded(end.vector);
        // `rounded` is exact for doubles; the relative term covers other directions.
        q = 4 * unit_roundoff * largest_of(direction_);
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_finite = direction_[axis] == 0;
            lower_[axis] = is_finite || direction_[axis] > 0 ? start_[axis] : -unbounded;
            upper_[axis] = is_finite || direction_[axis] < 0 ? start_[axis] : unbounded;
        }
    } else {
        const Enclosure to = enclose(end);
        direction_ = to.centre - start_;
        m = std::max(m, largest_of(to.centre));
        // Both ends have errors, and their difference is rounded.
        q = r + to.radius + 2 * unit_roundoff * m;
        lower_ = glm::min(start_, to.centre) - to.radius;
        upper_ = glm::max(start_, to.centre) + to.radius;
    }
    // Moving a bound by r rounds twice, each time by at most u·2M.
    const double margin = 2 * r + 8 * unit_roundoff * m;
    lower_ -= margin;
    upper_ += margin;
    // In a coordinate plane the line is D_i (c_j − A_j) − D_j (c_i − A_i) = 0 for a corner c. With
    // |c − A| ≤ 2M it is off by 4Mq for the direction, (|D_i| + |D_j|) r for the start, 7u (|D_i| +
    // |D_j|) M for rounding, and by 4Mq where the sign of D chooses the wrong corner.
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        const double extent = std::abs(direction_[i]) + std::abs(direction_[j]) + 2 * q;
        planes_[static_cast<std::size_t>(k)] = {
            i, j, 16 * m * q + 2 * extent * (r + 8 * unit_roundoff * m)};
    }
}

bool SegmentBounds::may_meet(const Vec3d& lower, const Vec3d& upper) const
{
    for (int axis = 0; axis < 3; ++axis) {
        if (upper[axis] < lower_[axis] || lower[axis] > upper_[axis]) {
            return false;
        }
    }
    // An infinite radius can lead to NaN; comparisons with NaN reject nothing.
    return std::ranges::all_of(planes_, [&](const Plane& plane) {
        const auto [i, j, slack] = plane;
        const double di = direction_[i];
        const double dj = direction_[j];
        const double highest = di * ((di >= 0 ? upper[j] : lower[j]) - start_[j]) -
                               dj * ((dj >= 0 ? lower[i] : upper[i]) - start_[i]);
        const double lowest = di * ((di >= 0 ? lower[j] : upper[j]) - start_[j]) -
                              dj * ((dj >= 0 ? upper[i] : lower[i]) - start_[i]);
        return !(highest < -slack || lowest > slack);
    });
}

TriangleBoxes::TriangleBoxes(const scene::TriangleScene& scene,
                             std::span<const scene::TriangleRange> ranges)
{
    for (const scene::TriangleRange& range : ranges) {
        for (std::uint32_t i = 0; i < range.count; ++i) {
            const std::uint32_t triangle = range.first + i;
            const auto [a, b, c] = scene.corners(triangle);
            entries_.push_back(
                {{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))}, triangle});
            for (const scene::Vec3f& corner : {a, b, c}) {
                largest_m_ = std::max(largest_m_, largest_of(Vec3d{corner}));
            }
        }
    }
    if (!entries_.empty()) {
        add_node(entries_);
    }
}

void TriangleBoxes::add_node(std::span<Entry> entries)
{
    constexpr std::size_t most_in_leaf = 4;
    Box box = entries.front().box;
    for (const Entry& entry : entries) {
        box = {glm::min(box.lower, entry.box.lower), glm::max(box.upper, entry.box.upper)};
    }
    const std::size_t index = nodes_.size();
    nodes_.push_back({box, entries, 0});
    if (entries.size() > most_in_leaf) {
        const scene::Vec3f size = box.upper - box.lower;
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t half = entries.size() / 2;
        std::ranges::nth_element(
            entries, entries.begin() + static_cast<std::ptrdiff_t>(half), {},
            [axis](const Entry& entry) { return entry.box.lower[axis] + entry.box.upper[axis]; });
        nodes_[index].entries = {};
        add_node(entries.first(half));
        nodes_[index].second_child = nodes_.size();
        add_node(entries.subspan(half));
    }
}

std::vector<std::uint32_t> TriangleBoxes::candidates(const Point& start, const Point& end) const
{
    const SegmentBounds segment{start, end, largest_m_};
    const auto may_meet = [&](const Box& box) {
        return segment.may_meet(Vec3d{box.lower}, Vec3d{box.upper});
    };
    std::vector<std::uint32_t> result;
    std::vector<std::size_t> open;
    if (!nodes_.empty()) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const std::size_t index = open.back();
        const Node& node = nodes_[index];
        open.pop_back();
        if (!may_meet(node.box)) {
            continue;
        }
        if (node.second_child != 0) {
            open.insert(open.end(), {node.second_child, index + 1});
        }
        for (const Entry& entry : node.entries) {
            if (may_meet(entry.box)) {
                result.push_back(entry.triangle);
            }
        }
    }
    std::ranges::sort(result);
    return result;
}

} // namespace gnomon::reference_rt::certificate
