// SPDX-License-Identifier: MIT
#pragma once

// Adapts the few interfaces that differ between Embree 3 and 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "engine/trace/ray_packet.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace limn {

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
inline constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using EmbreeContext = RTCIntersectContext;
inline constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// Sets the flags that every scene needs to be queried.
inline void setEmbreeFlags(RTCScene scene) {
    rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | kFilterFlag));
}

/// State of a query for the closest hit. Ties in distance go to the lowest instance, then the
/// lowest triangle, because Embree's own choice among coplanar triangles depends on its tree, and
/// so on objects far away.
struct FirstHit {
    EmbreeContext context; ///< must be first: the filter gets its address
    float t = std::numeric_limits<float>::infinity();
    std::uint64_t id = ~std::uint64_t(0);
};

inline void keepFirst(const RTCFilterFunctionNArguments* args) {
    FirstHit& first = *reinterpret_cast<FirstHit*>(args->context);
    float& t = RTCRayN_tfar(args->ray, 1, 0);
    const unsigned instance = RTCHitN_instID(args->hit, 1, 0, 0);
    const unsigned top =
        instance == RTC_INVALID_GEOMETRY_ID ? RTCHitN_geomID(args->hit, 1, 0) : instance;
    const std::uint64_t id = std::uint64_t(top) << 32 | RTCHitN_primID(args->hit, 1, 0);
    if (t > first.t || (t == first.t && id > first.id)) {
        args->valid[0] = 0;
        return;
    }
    first.t = t;
    first.id = id;
    t *= 1 + 0x1p-20f; // accepts nearby hits, too: Embree's comparisons round differently
}

inline void embreeIntersect(RTCScene scene, RTCRayHit& rayHit) {
    FirstHit first;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&first.context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    arguments.filter = keepFirst;
    arguments.context = &first.context;
    rtcIntersect1(scene, &rayHit, &arguments);
#else
    rtcInitIntersectContext(&first.context);
    first.context.filter = keepFirst;
    rtcIntersect1(scene, &first.context, &rayHit);
#endif
    if (rayHit.hit.geomID != RTC_INVALID_GEOMETRY_ID)
        rayHit.ray.tfar = first.t;
}

inline void embreeOccluded(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

static_assert(sizeof(RayPacket) == sizeof(RTCRay8) && alignof(RayPacket) == alignof(RTCRay8) &&
              offsetof(RayPacket, directionX) == offsetof(RTCRay8, dir_x) &&
              offsetof(RayPacket, tFar) == offsetof(RTCRay8, tfar) &&
              offsetof(RayPacket, flags) == offsetof(RTCRay8, flags));

/// Occlusion of rays that run alike; valid: -1 for those to trace, else 0. Eight are traced at
/// once: with sixteen, some queries of Embree 3.13 never end.
inline void embreeOccluded(RTCScene scene, const int* valid, RayPacket& packet) {
    auto* rays = reinterpret_cast<RTCRay8*>(&packet);
    EmbreeContext context;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &context;
    rtcOccluded8(valid, scene, rays, &arguments);
#else
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &context, rays);
#endif
}

} // namespace limn
