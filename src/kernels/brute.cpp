// SPDX-License-Identifier: Apache-2.0
// Every triangle, no tree, no float filter: the truth that the other kernels are measured against.

#include "kernels/queries-inl.h"
#include "kernels/ray_class.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

struct Brute {
  using State = NoState;

  template <class Counts>
  static bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, State&, Counts& counts) {
    if (!is_valid(ray)) {
      counts.invalid_ray();
      return false;
    }
    for (std::size_t i = 0; i < scene.kept_count; ++i) {
      counts.primitives(1);
      if (blocks(scene, filter, ray, scene.kept[i], counts)) return true;
    }
    return false;
  }

  template <class Counts>
  static void closest(const SceneView& scene, const Filter& filter, const Ray& ray, State&, Nearest& nearest,
                      Counts& counts) {
    if (!is_valid(ray)) {
      counts.invalid_ray();
      return;
    }
    for (std::size_t i = 0; i < scene.kept_count; ++i) {
      counts.primitives(1);
      nearest.offer(scene, filter, ray, scene.kept[i], counts);
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE

extern const Kernel kBruteKernel = {{"brute", "every triangle in turn; the truth, for tests and tiny scenes", false},
                                    &HWY_NAMESPACE::entry_points<HWY_NAMESPACE::Brute>,
                                    nullptr,
                                    false};

}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();
