#pragma once

#include "reference_rt/certificate/rational_geometry.hpp"
#include "scene/geometry/triangles.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::reference_rt::certificate {

/// Bounds in doubles that certainly enclose a segment from a finite point to a finite or infinite
/// one.
class SegmentBounds {
public:
    /// @param largest_m  at least as large as any coordinate of the tested boxes [m].
    SegmentBounds(const Point& start, const Point& end, double largest_m);

    /// False only if the segment certainly misses the closed box.
    [[nodiscard]] bool may_meet(const scene::Vec3d& lower, const scene::Vec3d& upper) const;

private:
    struct Plane {
        int i = 0; ///< the two axes of a coordinate plane
        int j = 0;
        double slack = 0;
    };

    scene::Vec3d start_;
    scene::Vec3d direction_;
    scene::Vec3d lower_;
    scene::Vec3d upper_;
    std::array<Plane, 3> planes_;
};

/// A tree of triangle bounding boxes, the certificate's only shortcut: a segment that certainly
/// misses a box misses everything in it.
class TriangleBoxes {
public:
    TriangleBoxes(const scene::TriangleScene& scene, std::span<const scene::TriangleRange> ranges);
    TriangleBoxes(const TriangleBoxes&) = delete; // its nodes point to its entries
    TriangleBoxes& operator=(const TriangleBoxes&) = delete;

    /// The triangles, in order, whose boxes the segment may meet.
    [[nodiscard]] std::vector<std::uint32_t> candidates(const Point& start, const Point& end) const;

private:
    struct Box {
        scene::Vec3f lower;
        scene::Vec3f upper;
    };
    struct Entry {
        Box box;
        std::uint32_t triangle = 0;
    };
    struct Node {
        Box box;
        std::span<const Entry> entries; ///< of a leaf
        std::size_t second_child = 0;   ///< 0: a leaf; the first child is the next node
    };

    /// Adds a subtree for these entries, of which there is at least one.
    void add_node(std::span<Entry> entries);

    std::vector<Entry> entries_;
    std::vector<Node> nodes_;
    double largest_m_ = 0;
};

} // namespace gnomon::reference_rt::certificate
