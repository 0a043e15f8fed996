// SPDX-License-Identifier: Apache-2.0
#include "scene.h"
namespace umbrix::scenes {
Scene forest() { Scene scene; scene.name = "forest"; return scene; }
}
