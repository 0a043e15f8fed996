// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"
#include "render/render.h"

namespace umbrix::render {

extern const Aov kNormalAov, kDepthAov, kAlbedoAov, kIndirectAov, kAmbientOcclusionAov, kShadowAov, kNodeTestsAov,
    kPrimitiveTestsAov, kKernelAov;

namespace {

const Aov* const kTable[] = {&kNormalAov, &kDepthAov,     &kAlbedoAov,         &kIndirectAov, &kAmbientOcclusionAov,
                             &kShadowAov, &kNodeTestsAov, &kPrimitiveTestsAov, &kKernelAov};

}  // namespace

const Aov* find_aov(const std::string& name) {
  for (const Aov* aov : kTable) {
    if (name == aov->name) return aov;
  }
  return nullptr;
}

std::vector<AovInfo> known_aovs() {
  std::vector<AovInfo> infos;
  for (const Aov* aov : kTable) {
    const HeatMapStyle style = aov->heat_map;
    infos.push_back({aov->name, aov->summary, style != HeatMapStyle::none, style == HeatMapStyle::scale,
                     aov->counts_work || style == HeatMapStyle::shares});
  }
  return infos;
}

std::vector<const char*> channel_names(const std::vector<const Aov*>& aovs) {
  std::vector<const char*> names;
  for (const Aov* aov : aovs) names.insert(names.end(), aov->channels.begin(), aov->channels.end());
  return names;
}

}  // namespace umbrix::render
