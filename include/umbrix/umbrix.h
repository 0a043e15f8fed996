// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Everything a host renderer needs; see scene.h first.

#include "umbrix/executor.h"
#include "umbrix/frame.h"
#include "umbrix/instance.h"
#include "umbrix/kernel.h"
#include "umbrix/mesh.h"
#include "umbrix/opacity.h"
#include "umbrix/ray.h"
#include "umbrix/scene.h"
#include "umbrix/stats.h"
#include "umbrix/status.h"
#include "umbrix/texels.h"
#include "umbrix/version.h"
