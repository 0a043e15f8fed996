// SPDX-License-Identifier: Apache-2.0
#include "core/transform.h"

#include "core/float_mode.h"
#include "umbrix/instance.h"

namespace umbrix {

void transform_point(const double to_world[3][4], const float local[3], float world[3]) noexcept {
  const detail::DefaultFloatMode mode;
  const detail::Vec3 p{local[0], local[1], local[2]};
  for (int row = 0; row < 3; ++row) {
    const double(&m)[4] = *(to_world + row);
    world[row] = detail::placed(m, p);
  }
}

}  // namespace umbrix
