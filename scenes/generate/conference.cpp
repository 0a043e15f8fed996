// SPDX-License-Identifier: Apache-2.0
#include "scene.h"
namespace umbrix::scenes {
Scene conference() { Scene scene; scene.name = "conference"; return scene; }
}
