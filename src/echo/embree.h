// embree.h -- Embree 4 or 3, whichever CMake found, and the two calls in which they differ.

#pragma once

#if INSONIFY_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace insonify {

/// Whether the rays of a packet have similar origins and directions, which selects Embree's traversal.
enum class Coherence { kAlike, kScattered };

/// Finds the nearest hit of each of sixteen rays; `valid` is -1 for lanes in use, else 0.
inline void embree_intersect(RTCScene scene, const int* valid, RTCRayHit16& rays, Coherence coherence) {
#if INSONIFY_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = coherence == Coherence::kAlike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherence == Coherence::kAlike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
#endif
}

/// Finds whether each of sixteen rays hits anything; tfar of those that do becomes negative.
inline void embree_occluded(RTCScene scene, const int* valid, RTCRay16& rays, Coherence coherence) {
#if INSONIFY_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = coherence == Coherence::kAlike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherence == Coherence::kAlike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
#endif
}

}  // namespace insonify
