// SPDX-License-Identifier: Apache-2.0
// The larger child first (Nah & Manocha 2014), for four readings of "larger".

#include "index/sato_order.h"
#include "kernels/ordered.h"

namespace umbrix::detail {
namespace {

template <SatoMeasure kMeasure>
std::unique_ptr<SideTable> make(const PrepareInput& input) {
  return make_sato_order(*input.scene.tree, kMeasure, input.training.executor);
}

}  // namespace

extern const Kernel kSatoBoxKernel, kSatoAreaKernel, kSatoCountKernel, kSatoCellKernel;

const Kernel kSatoBoxKernel = {{"sato-box", "the child with the larger box of what it holds first", true},
                               &ordered_entry_points,
                               &make<SatoMeasure::tight_box>};
const Kernel kSatoAreaKernel = {{"sato-area", "the child with more triangle area first", true},
                                &ordered_entry_points,
                                &make<SatoMeasure::triangle_area>};
const Kernel kSatoCountKernel = {{"sato-count", "the child with more triangles first", true},
                                 &ordered_entry_points,
                                 &make<SatoMeasure::triangle_count>};
const Kernel kSatoCellKernel = {{"sato-cell", "the child with the larger cell first, empty ones last", true},
                                &ordered_entry_points,
                                &make<SatoMeasure::cell>};

}  // namespace umbrix::detail
