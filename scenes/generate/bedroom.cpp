// SPDX-License-Identifier: Apache-2.0
#include "scene.h"
namespace umbrix::scenes {
Scene bedroom() { Scene scene; scene.name = "bedroom"; return scene; }
}
