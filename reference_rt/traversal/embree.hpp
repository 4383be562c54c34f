#pragma once

#include <cstdint>
#include <memory>

#if GNOMON_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/// Wraps Embree 3 and 4; no other code depends on the version.
namespace gnomon::reference_rt::embree {

/// Deleter for Embree's counted handles; stateless, so owners stay pointer-sized.
template <auto release>
struct Release {
    template <typename Handle>
    void operator()(Handle* handle) const noexcept
    {
        release(handle);
    }
};
using Device = std::unique_ptr<RTCDeviceTy, Release<rtcReleaseDevice>>;
using Scene = std::unique_ptr<RTCSceneTy, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release<rtcReleaseGeometry>>;

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
inline constexpr RTCSceneFlags filtering_scene = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using QueryContext = RTCIntersectContext;
inline constexpr RTCSceneFlags filtering_scene = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

enum class Coherence : std::uint8_t { incoherent, coherent };

/// The options of a ray query: coherence, and a filter for each candidate hit.
struct Query {
    /// @param filter   called for each candidate hit, or null; must not throw.
    /// @param payload  returned to callbacks by `payload_of`; not owned.
    explicit Query(Coherence coherence, RTCFilterFunctionN filter = nullptr,
                   void* payload = nullptr);

    QueryContext context{}; ///< first member, so that callbacks can cast its address to the query
    void* payload = nullptr;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments intersect{};
    RTCOccludedArguments occluded{};
#endif
};

/// The payload of the query that invoked a callback.
template <typename Payload, typename Arguments>
[[nodiscard]] Payload& payload_of(const Arguments& arguments)
{
    return *static_cast<Payload*>(reinterpret_cast<const Query*>(arguments.context)->payload);
}

#if RTC_VERSION_MAJOR >= 4

inline Query::Query(Coherence coherence, RTCFilterFunctionN filter, void* payload_in)
    : payload{payload_in}
{
    rtcInitRayQueryContext(&context);
    rtcInitIntersectArguments(&intersect);
    rtcInitOccludedArguments(&occluded);
    int flags = coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT
                                                 : RTC_RAY_QUERY_FLAG_INCOHERENT;
    if (filter != nullptr) {
        flags |= RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    }
    intersect.flags = occluded.flags = static_cast<RTCRayQueryFlags>(flags);
    intersect.filter = occluded.filter = filter;
    intersect.context = occluded.context = &context;
}

inline void intersect1(RTCScene scene, Query& query, RTCRayHit& ray)
{
    rtcIntersect1(scene, &ray, &query.intersect);
}
inline void intersect16(const int* valid, RTCScene scene, Query& query, RTCRayHit16& rays)
{
    rtcIntersect16(valid, scene, &rays, &query.intersect);
}
inline void occluded16(const int* valid, RTCScene scene, Query& query, RTCRay16& rays)
{
    rtcOccluded16(valid, scene, &rays, &query.occluded);
}

#else

inline Query::Query(Coherence coherence, RTCFilterFunctionN filter, void* payload_in)
    : payload{payload_in}
{
    rtcInitIntersectContext(&context);
    context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context.filter = filter;
}

inline void intersect1(RTCScene scene, Query& query, RTCRayHit& ray)
{
    rtcIntersect1(scene, &query.context, &ray);
}
inline void intersect16(const int* valid, RTCScene scene, Query& query, RTCRayHit16& rays)
{
    rtcIntersect16(valid, scene, &query.context, &rays);
}
inline void occluded16(const int* valid, RTCScene scene, Query& query, RTCRay16& rays)
{
    rtcOccluded16(valid, scene, &query.context, &rays);
}

#endif

} // namespace gnomon::reference_rt::embree
