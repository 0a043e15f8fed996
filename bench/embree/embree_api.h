// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The few calls that differ between Embree 3 and 4.

#if UMBRIX_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace umbrix::embree {

#if UMBRIX_EMBREE_MAJOR >= 4

class Query {
 public:
  Query(RTCScene scene, bool coherent) : scene_(scene) {
    rtcInitOccludedArguments(&arguments_);
    if (coherent) arguments_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  void occluded(RTCRay& ray) { rtcOccluded1(scene_, &ray, &arguments_); }
  void occluded(const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene_, &rays, &arguments_); }
  void occluded(const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene_, &rays, &arguments_); }

 private:
  RTCScene scene_;
  RTCOccludedArguments arguments_;
};

#else

class Query {
 public:
  Query(RTCScene scene, bool coherent) : scene_(scene) {
    rtcInitIntersectContext(&context_);
    if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void occluded(RTCRay& ray) { rtcOccluded1(scene_, &context_, &ray); }
  void occluded(const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene_, &context_, &rays); }
  void occluded(const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene_, &context_, &rays); }
  void occluded_stream(RTCRay* rays, unsigned count) { rtcOccluded1M(scene_, &context_, rays, count, sizeof(RTCRay)); }

 private:
  RTCScene scene_;
  RTCIntersectContext context_;
};

#endif

}  // namespace umbrix::embree
