// SPDX-License-Identifier: MIT
#pragma once

// The few places where Embree 3 and 4 differ.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace limn {

inline void embreeIntersect(RTCScene scene, RTCRayHit& rayHit) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &rayHit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &rayHit);
#endif
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

} // namespace limn
