#include "reference_rt/pixels/tiles.hpp"

#include <algorithm>
#include <bit>
#include <memory>

namespace gnomon::reference_rt {

using scene::Camera;
using scene::no_triangle;
using scene::Projection;

namespace {

using TileSide = std::array<double, tile_side_px>;

/// Computes the pixels' rays from sx by column and sy by row.
GNOMON_WIDEST_VECTORS
void make_rays(const Camera& camera_in, const TileSide& sx_in, const TileSide& sy_in,
               LaneRays& rays)
{
    const Camera camera = camera_in; // a copy that cannot alias the rays
    Lanes<double> sx;
    Lanes<double> sy;
    for (std::size_t i = 0; i < packet_size; ++i) {
        sx[i] = sx_in[i % tile_side_px];
        sy[i] = sy_in[i / tile_side_px];
    }
    for (std::size_t i = 0; i < packet_size; ++i) {
        const scene::Ray ray = pixel_ray(camera, sx[i], sy[i]);
        rays.origin.x[i] = ray.origin.x;
        rays.origin.y[i] = ray.origin.y;
        rays.origin.z[i] = ray.origin.z;
        rays.direction.x[i] = ray.direction.x;
        rays.direction.y[i] = ray.direction.y;
        rays.direction.z[i] = ray.direction.z;
    }
    Lanes<int> well_scaled;
    for (std::size_t i = 0; i < packet_size; ++i) {
        well_scaled[i] = static_cast<int>(
            is_well_scaled({rays.origin.x[i], rays.origin.y[i], rays.origin.z[i]}) &
            is_well_scaled({rays.direction.x[i], rays.direction.y[i], rays.direction.z[i]}));
    }
    rays.is_well_scaled = bits_of(well_scaled);
}

/// The planes of a packet's receivers: values and permanents of n and ν.
struct LanePlanes {
    Lanes3 normal, normal_permanent;
    Lanes<double> nu, nu_permanent;
};

/// Fills `hits` for well-scaled rays as far as doubles prove it. Lanes without a sign of δ remain
/// undecided.
GNOMON_WIDEST_VECTORS
void meet_planes(const LaneRays& rays, const LanePlanes& planes, LaneHits& hits)
{
    const Lanes3& n = planes.normal;
    const Lanes3& permanent = planes.normal_permanent;
    LaneHits found; // local, so that stores cannot alias the inputs
    Lanes<int> is_positive;
    Lanes<int> is_negative;
    for (std::size_t i = 0; i < packet_size; ++i) {
        const Vec3 normal{Filtered<4>{n.x[i], permanent.x[i]}, Filtered<4>{n.y[i], permanent.y[i]},
                          Filtered<4>{n.z[i], permanent.z[i]}};
        const Filtered<7> delta = dot(
            normal,
            vector<FilterField>({rays.direction.x[i], rays.direction.y[i], rays.direction.z[i]}));
        const PlaneDistance distance =
            plane_distance(delta, Filtered<8>{planes.nu[i], planes.nu_permanent[i]}, true);
        found.t[i] = distance.t;
        found.t_error[i] = distance.t_error;
        is_positive[i] = static_cast<int>(delta.value > delta.error());
        is_negative[i] = static_cast<int>(delta.value < -delta.error());
    }
    found.delta_is_positive = bits_of(is_positive);
    found.delta_is_negative = bits_of(is_negative);
    hits = found;
}

/// Gives every lane a plane; lanes without a triangle get the first one.
GNOMON_WIDEST_VECTORS
void broadcast(const FilteredNormal& normal, const Filtered<8>& nu, LanePlanes& planes)
{
    planes.normal.x.fill(normal.x.value);
    planes.normal.y.fill(normal.y.value);
    planes.normal.z.fill(normal.z.value);
    planes.normal_permanent.x.fill(normal.x.permanent);
    planes.normal_permanent.y.fill(normal.y.permanent);
    planes.normal_permanent.z.fill(normal.z.permanent);
    planes.nu.fill(nu.value);
    planes.nu_permanent.fill(nu.permanent);
}

void set_lane(const FilteredNormal& normal, const Filtered<8>& nu, std::size_t lane,
              LanePlanes& planes)
{
    planes.normal.x[lane] = normal.x.value;
    planes.normal.y[lane] = normal.y.value;
    planes.normal.z[lane] = normal.z.value;
    planes.normal_permanent.x[lane] = normal.x.permanent;
    planes.normal_permanent.y[lane] = normal.y.permanent;
    planes.normal_permanent.z[lane] = normal.z.permanent;
    planes.nu[lane] = nu.value;
    planes.nu_permanent[lane] = nu.permanent;
}

/// The planes of the lanes in `seen`; other lanes get arbitrary planes.
LanePlanes planes_of(const Tile& tile, bool has_eye)
{
    LanePlanes planes;
    for (std::size_t f = 0; f < tile.face_count; ++f) {
        const ExactTriangle& face = tile.faces[f];
        const std::size_t first = first_lane(tile.face_lanes[f]);
        const Filtered<8> shared_nu = nu_of(face, tile.rays.ray(first).ray.origin);
        if (f == 0) {
            broadcast(face.normal, shared_nu, planes);
        }
        if (f == 0 && has_eye) {
            continue;
        }
        for (LaneBits rest = tile.face_lanes[f]; rest != 0; rest &= rest - 1) {
            const std::size_t lane = first_lane(rest);
            const Filtered<8> nu =
                has_eye ? shared_nu : nu_of(face, tile.rays.ray(lane).ray.origin);
            set_lane(face.normal, nu, lane, planes);
        }
    }
    return planes;
}

/// Rounds up to whole tiles.
int tiled(int length_px)
{
    return (length_px + tile_side_px - 1) / tile_side_px * tile_side_px;
}

} // namespace

const ExactTriangle& Tile::face(std::size_t lane) const
{
    std::size_t f = 0;
    while ((face_lanes[f] >> lane & 1U) == 0) {
        ++f;
    }
    return faces[f];
}

const Receiver& Tile::receiver(std::size_t lane, SignCounts& counts) const
{
    if ((made_ >> lane & 1U) == 0) {
        made_ |= LaneBits{1} << lane;
        std::construct_at(&camera_rays_[lane], rays.ray(lane));
        std::construct_at(&receivers_[lane], face(lane), camera_rays_[lane], counts);
    }
    return receivers_[lane];
}

const PacketOf<Receiver>& Tile::receivers() const
{
    for (LaneBits rest = seen; rest != 0; rest &= rest - 1) {
        (void)receiver(first_lane(rest));
    }
    return receivers_;
}

TileSource::TileSource(const scene::TriangleScene& triangles, const scene::View& view,
                       const scene::Image<std::uint32_t>& receivers)
    : triangles_{triangles},
      view_{view},
      receivers_{receivers},
      has_eye_{view.camera.projection == Projection::perspective}
{
    for (int x = 0; x < tiled(view.image.width_px); ++x) {
        sx_.push_back(pixel_sx(view.camera, view.image, x));
    }
    for (int y = 0; y < tiled(view.image.height_px); ++y) {
        sy_.push_back(pixel_sy(view.camera, view.image, y));
    }
}

void TileSource::fill(Tile& tile, int column, int row, SignCounts& counts) const
{
    tile.left = column * tile_side_px;
    tile.top = row * tile_side_px;
    tile.made_ = 0;
    find_rays(tile);
    look_up(tile);
    find_faces(tile);
    if (tile.seen != 0) {
        find_hits(tile, counts);
    }
}

void TileSource::find_rays(Tile& tile) const
{
    TileSide sx;
    TileSide sy;
    std::copy_n(sx_.begin() + tile.left, tile_side_px, sx.begin());
    std::copy_n(sy_.begin() + tile.top, tile_side_px, sy.begin());
    make_rays(view_.camera, sx, sy, tile.rays);
}

void TileSource::look_up(Tile& tile) const
{
    const int columns = std::min(tile_side_px, view_.image.width_px - tile.left);
    const int rows = std::min(tile_side_px, view_.image.height_px - tile.top);
    tile.valid = 0;
    tile.triangles.fill(no_triangle);
    for (int y = 0; y < rows; ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * tile_side_px;
        std::copy_n(&receivers_(tile.left, tile.top + y), columns, &tile.triangles[first]);
        tile.valid |= ((LaneBits{1} << columns) - 1) << first;
    }
    tile.seen = tile.valid & ~lanes_with(tile.triangles, no_triangle);
}

void TileSource::find_faces(Tile& tile) const
{
    tile.face_count = 0;
    for (LaneBits rest = tile.seen; rest != 0;) {
        const std::uint32_t triangle = tile.triangles[first_lane(rest)];
        const LaneBits lanes = lanes_with(tile.triangles, triangle);
        ExactTriangle& face = tile.faces[tile.face_count];
        if (face.triangle != triangle) { // the previous tile often shows the same triangle
            face = {triangles_, triangle};
        }
        tile.face_lanes[tile.face_count] = lanes;
        ++tile.face_count;
        rest &= ~lanes;
    }
}

void TileSource::find_hits(Tile& tile, SignCounts& counts) const
{
    LaneHits& hits = tile.hits;
    meet_planes(tile.rays, planes_of(tile, has_eye_), hits);
    const LaneBits certain =
        tile.seen & tile.rays.is_well_scaled & (hits.delta_is_positive | hits.delta_is_negative);
    counts.filtered += static_cast<std::uint64_t>(std::popcount(certain));
    hits.delta_is_positive &= certain;
    hits.delta_is_negative &= certain;
    for (LaneBits rest = tile.seen & ~certain; rest != 0; rest &= rest - 1) {
        const std::size_t lane = first_lane(rest);
        const Receiver& receiver = tile.receiver(lane, counts);
        hits.t_error[lane] = receiver.t_error;
        hits.delta_is_positive |= receiver.delta_sign > 0 ? LaneBits{1} << lane : 0;
        hits.delta_is_negative |= receiver.delta_sign < 0 ? LaneBits{1} << lane : 0;
    }
}

} // namespace gnomon::reference_rt
