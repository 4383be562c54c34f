#include "reference_rt/embree_scene.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace gnomon::reference_rt {

using scene::TriangleScene;

void EmbreeErrors::record(void* self, RTCError code, const char* message) noexcept
{
    auto& errors = *static_cast<EmbreeErrors*>(self);
    const std::scoped_lock lock{errors.mutex_};
    if (errors.code_ != RTC_ERROR_NONE) {
        return;
    }
    errors.code_ = code;
    try {
        errors.message_ = message == nullptr ? "" : message;
    } catch (const std::bad_alloc&) {
        errors.message_.clear(); // the code alone still tells
    }
}

void EmbreeErrors::check(const char* during) const
{
    const std::scoped_lock lock{mutex_};
    if (code_ == RTC_ERROR_NONE) {
        return;
    }
    throw scene::EnvironmentError{fmt::format(
        "Embree failed in {}: error {} ({}); {}", during, static_cast<int>(code_), message_,
        code_ == RTC_ERROR_OUT_OF_MEMORY ? "free memory or use a smaller scene"
                                         : "run `gnomon doctor`")};
}

namespace {

embree::Device make_device(int threads, EmbreeErrors& errors)
{
    const std::string config = threads > 0 ? fmt::format("threads={}", threads) : "";
    embree::Device device{rtcNewDevice(config.c_str())};
    if (!device) {
        throw scene::EnvironmentError{
            fmt::format("rtcNewDevice failed: error {}; run `gnomon doctor`",
                        static_cast<int>(rtcGetDeviceError(nullptr)))};
    }
    rtcSetDeviceErrorFunction(device.get(), &EmbreeErrors::record, &errors);
    return device;
}

double largest_coordinate(const scene::Box& box)
{
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        largest = std::max({largest, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
    }
    return largest;
}

/// The triangles of each pair of roles, by mask.
std::array<std::vector<std::uint32_t>, 4> triangles_by_mask(const TriangleScene& scene)
{
    std::array<std::vector<std::uint32_t>, 4> members;
    for (const scene::Object& object : scene.objects) {
        const unsigned mask =
            (object.casts ? unsigned{casters} : 0U) | (object.receives ? unsigned{receivers} : 0U);
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            members[mask].push_back(object.first_triangle + i);
        }
    }
    return members;
}

} // namespace

ReferenceScene::Implementation::Implementation(const TriangleScene& scene_in, int threads)
    : triangles{scene_in},
      bounds{scene_in.bounds()},
      largest_coordinate_m{largest_coordinate(bounds)},
      device{make_device(threads, errors)},
      scene{rtcNewScene(device.get())}
{
    errors.check("rtcNewScene");
    // Embree reads 16 bytes at each 12-byte vertex: the last one needs readable bytes behind it.
    triangles.vertices.reserve(triangles.vertices.size() + 1);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | embree::filtering_scene);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
    auto members = triangles_by_mask(triangles);
    for (unsigned mask = 1; mask < members.size(); ++mask) {
        if (!members[mask].empty()) {
            add_geometry(mask, std::move(members[mask]));
        }
    }
    rtcCommitScene(scene.get());
    errors.check("rtcCommitScene");
}

void ReferenceScene::Implementation::add_geometry(unsigned mask, std::vector<std::uint32_t> members)
{
    const embree::Geometry geometry{rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE)};
    errors.check("rtcNewGeometry");
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               triangles.vertices.data(), 0, sizeof(scene::Vec3f),
                               triangles.vertices.size());
    constexpr std::size_t bytes_per_triangle = sizeof(triangles.triangles[0]);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                bytes_per_triangle, members.size()));
    errors.check("rtcSetNewGeometryBuffer");
    for (std::size_t i = 0; i < members.size(); ++i) {
        std::memcpy(indices + 3 * i, triangles.triangles[members[i]].data(), bytes_per_triangle);
    }
    rtcSetGeometryMask(geometry.get(), mask);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), static_cast<unsigned>(triangle_of.size()));
    errors.check("rtcAttachGeometryByID");
    triangle_of.push_back(std::move(members));
}

ReferenceScene::ReferenceScene(const TriangleScene& triangles, int threads)
    : implementation_{std::make_unique<Implementation>(triangles, threads)}
{
}
ReferenceScene::~ReferenceScene() = default;
ReferenceScene::ReferenceScene(ReferenceScene&&) noexcept = default;
ReferenceScene& ReferenceScene::operator=(ReferenceScene&&) noexcept = default;

const TriangleScene& ReferenceScene::triangles() const
{
    return implementation_->triangles;
}

} // namespace gnomon::reference_rt
