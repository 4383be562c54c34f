#include "reference_rt/rounded/rounded_truth.hpp"

#include "reference_rt/pixels/classify.hpp"
#include "reference_rt/pixels/pixel_packets.hpp"
#include "reference_rt/pixels/tiles.hpp"
#include "reference_rt/rounded/nearest_surface.hpp"
#include "reference_rt/rounded/rounded_segments.hpp"

#include <glm/geometric.hpp>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::Image;
using scene::LightType;
using scene::NearestSurface;
using scene::no_object;
using scene::no_triangle;
using scene::PixelClass;
using scene::RoundedReceivers;
using scene::RoundedTruth;
using scene::SurfaceScope;
using scene::Vec3d;
using scene::Vec3f;

namespace {

bool is_finite(const Vec3f& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const RoundedReceivers& receivers, const scene::TriangleScene& triangles)
{
    const scene::ImageSize image = receivers.position.size();
    if ((!receivers.normal.empty() && receivers.normal.size() != image) ||
        (!receivers.object.empty() && receivers.object.size() != image)) {
        throw std::invalid_argument{"compute_rounded_truth: images differ in size"};
    }
    for (const std::uint32_t object : receivers.object) {
        if (object != no_object && object >= triangles.objects.size()) {
            throw std::invalid_argument{"compute_rounded_truth: an object is not in the scene"};
        }
    }
}

/// Computes the truth of one image.
class RoundedRun {
public:
    RoundedRun(const ReferenceScene::Implementation& reference, const scene::Light& light,
               const RoundedReceivers& receivers)
        : reference_{reference},
          light_{light},
          receivers_{receivers},
          truth_{empty_layers(receivers.position.size()),
                 Image<std::uint32_t>{receivers.position.size(), no_triangle},
                 Image<float>{receivers.position.size()}, Image<float>{receivers.position.size()}}
    {
    }

    /// Lists the hypotheses of each pixel.
    void find_hypotheses()
    {
        const auto height = static_cast<std::size_t>(receivers_.position.size().height_px);
        std::vector<std::vector<Hypothesis>> rows(height);
        tbb::parallel_for(tbb::blocked_range<std::size_t>{0, height},
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              NearbySurfaces search{reference_};
                              for (std::size_t row = range.begin(); row != range.end(); ++row) {
                                  suppose_row(row, search, rows[row]);
                              }
                          });
        for (const auto& row : rows) {
            hypotheses_.insert(hypotheses_.end(), row.begin(), row.end());
        }
        verdicts_.resize(hypotheses_.size());
    }

    /// Decides every hypothesis; those with unusually large boxes use a separate hierarchy.
    void decide(const ReferenceOptions& wide_options)
    {
        std::vector<std::size_t> usual;
        std::vector<std::size_t> wide;
        double farthest_m = 0;
        for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
            const double reach_m = reach_of(hypotheses_[i]);
            const bool fits = reference_.frame.scale() * reach_m <= start_reach(reference_);
            (fits ? usual : wide).push_back(i);
            farthest_m = std::max(farthest_m, fits ? 0 : reach_m);
        }
        decide(reference_, usual);
        if (!wide.empty()) {
            ReferenceOptions options = wide_options;
            options.start_error_m = farthest_m;
            const ReferenceScene::Implementation padded{reference_.triangles, options};
            decide(padded, wide);
            padded.errors.check("compute_rounded_truth");
        }
    }

    /// A pixel's class is the one that all its hypotheses agree on.
    [[nodiscard]] RoundedTruth take()
    {
        std::size_t next = 0;
        for (std::size_t pixel = 0; pixel < receivers_.position.pixel_count(); ++pixel) {
            const std::size_t first = next;
            while (next < hypotheses_.size() && hypotheses_[next].pixel == pixel) {
                ++next;
            }
            if (next > first) {
                write(pixel, std::span{verdicts_}.subspan(first, next - first));
            }
        }
        counts_.combine_each([&](const SignCounts& counts) {
            truth_.truth.signs.filtered += counts.filtered;
            truth_.truth.signs.exact += counts.exact;
        });
        return std::move(truth_);
    }

private:
    void suppose_row(std::size_t row, NearbySurfaces& search, std::vector<Hypothesis>& found)
    {
        SignCounts& counts = counts_.local();
        const auto width = static_cast<std::size_t>(receivers_.position.size().width_px);
        for (std::size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
            const Vec3f& position = receivers_.position[pixel];
            if (is_finite(position)) {
                suppose_pixel(pixel, position, search, found, counts);
            }
        }
    }

    void suppose_pixel(std::size_t pixel, const Vec3f& position, NearbySurfaces& search,
                       std::vector<Hypothesis>& found, SignCounts& counts)
    {
        const SurfaceScope scope{receivers_.object.empty() ? no_object : receivers_.object[pixel],
                                 receivers_.most_distance_m};
        const RoundingBox box = rounding_box(position, 0);
        const double extent_m = 0.5 * glm::length(box.upper - box.lower);
        const auto& nearby = search.find_all(Vec3d{position}, extent_m, scope);
        if (nearby.empty()) {
            leave_open(pixel, search.find_nearest(Vec3d{position}, {}));
            return;
        }
        const auto nearest = std::min_element(nearby.begin(), nearby.end(),
                                              [](const NearbyTriangle& a, const NearbyTriangle& b) {
                                                  return a.distance_m < b.distance_m;
                                              });
        const ExactTriangle face{reference_.triangles, nearest->triangle};
        const double growth_m = growth_to_plane_m(position, face, counts);
        truth_.triangle[pixel] = nearest->triangle;
        truth_.distance_m[pixel] = static_cast<float>(nearest->distance_m);
        truth_.growth_m[pixel] = static_cast<float>(growth_m);
        const RoundingBox grown = rounding_box(position, growth_m);
        const double reach_m = 0.5 * (1 + 0x1p-30) * glm::length(grown.upper - grown.lower);
        for (const NearbyTriangle& t : nearby) {
            const bool may_be_shown =
                t.triangle == nearest->triangle ||
                (t.distance_m <= reach_m &&
                 meets_plane(grown, {reference_.triangles, t.triangle}, counts));
            if (may_be_shown) {
                found.push_back({pixel, t.triangle, growth_m});
            }
        }
    }

    /// Leaves a pixel open whose P is not on any possible surface.
    void leave_open(std::size_t pixel, const scene::NearestSurface& nearest)
    {
        if (nearest.triangle == no_triangle) {
            return;
        }
        truth_.triangle[pixel] = nearest.triangle;
        truth_.distance_m[pixel] = static_cast<float>(nearest.distance_m);
        truth_.growth_m[pixel] = std::numeric_limits<float>::infinity();
        truth_.truth.pixel_class[pixel] = PixelClass::indeterminate;
        truth_.truth.reason[pixel] = ClassReason::rounding;
    }

    [[nodiscard]] double reach_of(const Hypothesis& hypothesis) const
    {
        const Vec3f& position = receivers_.position[hypothesis.pixel];
        return rounding_box(position, hypothesis.growth_m).reach_m(Vec3d{position});
    }

    void decide(const ReferenceScene::Implementation& reference,
                const std::vector<std::size_t>& chosen)
    {
        const SegmentLight light{reference, light_};
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>{0, (chosen.size() + packet_size - 1) / packet_size},
            [&](const tbb::blocked_range<std::size_t>& range) {
                for (std::size_t packet = range.begin(); packet != range.end(); ++packet) {
                    const std::size_t first = packet * packet_size;
                    decide_packet(reference, light,
                                  std::span{chosen}.subspan(
                                      first, std::min(packet_size, chosen.size() - first)));
                }
            });
    }

    void decide_packet(const ReferenceScene::Implementation& reference, const SegmentLight& light,
                       std::span<const std::size_t> chosen)
    {
        SignCounts& counts = counts_.local();
        std::array<std::size_t, packet_size> asked{};
        PacketOf<RoundedStart> starts;
        std::size_t count = 0;
        for (const std::size_t index : chosen) {
            const Hypothesis& hypothesis = hypotheses_[index];
            const Vec3f& position = receivers_.position[hypothesis.pixel];
            RoundedStart& start = starts[count];
            start.face = {reference.triangles, hypothesis.triangle};
            start.box = rounding_box(position, hypothesis.growth_m);
            start.point = Vec3d{position};
            if (const auto known = class_without_segment(hypothesis.pixel, start, counts)) {
                verdicts_[index] = {*known, no_triangle};
            } else {
                asked[count++] = index;
            }
        }
        if (count == 0) {
            return;
        }
        const auto verdicts =
            trace_rounded_segments(reference, light, {starts.data(), count}, counts);
        for (std::size_t i = 0; i < count; ++i) {
            verdicts_[asked[i]] = verdicts[i];
        }
    }

    /// `attached`, `out_of_light`, or `indeterminate` at a cone's border; empty if the segments
    /// decide.
    [[nodiscard]] std::optional<PixelClass>
    class_without_segment(std::size_t pixel, const RoundedStart& start, SignCounts& counts) const
    {
        const Sign side = light_side(start.face, light_, counts);
        const Sign seen = seen_side(pixel, start.face, counts);
        if (side == 0 || (seen != 0 && seen != side)) {
            return PixelClass::attached;
        }
        if (!light_.has_cone()) {
            return std::nullopt;
        }
        switch (place_in_cone(start, counts)) {
        case ConePlace::inside:
            return std::nullopt;
        case ConePlace::outside:
            return PixelClass::out_of_light;
        case ConePlace::border:
            break;
        }
        return PixelClass::indeterminate;
    }

    /// The visible side of T, from the eye or else from the normal; 0 if unknown.
    [[nodiscard]] Sign seen_side(std::size_t pixel, const ExactTriangle& face,
                                 SignCounts& counts) const
    {
        if (receivers_.eye) {
            const Sign side =
                sign_of(counts, is_well_scaled(*receivers_.eye), [&]<typename Field>(Field) {
                    return dot(normal_of<Field>(face.corners),
                               difference<Field>(*receivers_.eye, face.corners[0]));
                });
            if (side != 0) {
                return side;
            }
        }
        if (receivers_.normal.empty() || !is_finite(receivers_.normal[pixel])) {
            return 0;
        }
        const Vec3d normal{receivers_.normal[pixel]};
        return sign_of(counts, is_well_scaled(normal), [&]<typename Field>(Field) {
            return dot(normal_of<Field>(face.corners), vector<Field>(normal));
        });
    }

    enum class ConePlace : std::uint8_t { inside, outside, border };

    /// With f(Q) = (Q − L)·a − c|Q − L||a|, inside where f >= 0, f changes by at most 2|a| per unit
    /// of distance. The cone is convex, so a polygon with all corners inside is inside.
    [[nodiscard]] ConePlace place_in_cone(const RoundedStart& start, SignCounts& counts) const
    {
        const Vec3d from_light = start.point - light_.position;
        const double axis = glm::length(light_.direction);
        const double way = glm::length(from_light);
        const double height =
            glm::dot(from_light, light_.direction) - light_.cos_half_cone * way * axis;
        const double reach = glm::length(start.box.upper - start.box.lower);
        const double margin = 2 * axis * reach + 0x1p-48 * way * axis;
        if (height < -margin) {
            return ConePlace::outside;
        }
        if (height > margin) {
            return ConePlace::inside;
        }
        const PlaneSection section{start.box, start.face, counts};
        const auto is_lit = [&](const Receiver& corner) {
            return !is_out_of_light(corner, light_, counts);
        };
        return std::ranges::all_of(section.corners(), is_lit) ? ConePlace::inside
                                                              : ConePlace::border;
    }

    void write(std::size_t pixel, std::span<const HypothesisVerdict> verdicts)
    {
        const HypothesisVerdict& verdict = verdicts.front();
        const bool agree =
            std::all_of(verdicts.begin(), verdicts.end(), [&](const HypothesisVerdict& other) {
                return other.pixel_class == verdict.pixel_class;
            });
        const PixelClass pixel_class = agree ? verdict.pixel_class : PixelClass::indeterminate;
        truth_.truth.pixel_class[pixel] = pixel_class;
        if (pixel_class == PixelClass::indeterminate) {
            truth_.truth.reason[pixel] = ClassReason::rounding;
        } else {
            truth_.truth.witness[pixel] = verdict.witness;
        }
    }

    const ReferenceScene::Implementation& reference_;
    const scene::Light& light_;
    const RoundedReceivers& receivers_;
    RoundedTruth truth_;
    std::vector<Hypothesis> hypotheses_; ///< in pixel order
    std::vector<HypothesisVerdict> verdicts_;
    tbb::combinable<SignCounts> counts_;
};

} // namespace

RoundedTruth compute_rounded_truth(const ReferenceScene& reference, const scene::Light& light,
                                   const RoundedReceivers& receivers, int threads)
{
    const auto& implementation = reference.implementation();
    if (!implementation.padded) {
        throw std::invalid_argument{"compute_rounded_truth: the reference must serve exact truth"};
    }
    check(receivers, implementation.triangles);
    RoundedRun run{implementation, light, receivers};
    with_threads(threads, [&] {
        run.find_hypotheses();
        run.decide({.threads = threads});
    });
    implementation.errors.check("compute_rounded_truth");
    return run.take();
}

std::vector<NearestSurface> nearest_surfaces(const ReferenceScene& reference,
                                             std::span<const Vec3d> points,
                                             std::span<const SurfaceScope> scopes, int threads)
{
    const auto& implementation = reference.implementation();
    if (!implementation.padded) {
        throw std::invalid_argument{"nearest_surfaces: the reference must serve exact truth"};
    }
    if (!scopes.empty() && scopes.size() != points.size()) {
        throw std::invalid_argument{"nearest_surfaces: not a scope for each point"};
    }
    std::vector<NearestSurface> found(points.size());
    with_threads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>{0, points.size(), 1024},
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              NearbySurfaces search{implementation};
                              for (std::size_t i = range.begin(); i != range.end(); ++i) {
                                  if (std::isfinite(glm::dot(points[i], Vec3d{1.0}))) {
                                      found[i] = search.find_nearest(
                                          points[i], scopes.empty() ? SurfaceScope{} : scopes[i]);
                                  }
                              }
                          });
    });
    implementation.errors.check("nearest_surfaces");
    return found;
}

} // namespace gnomon::reference_rt
