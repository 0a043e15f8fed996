// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace umbrix::app {

/// The threads this process may keep busy: those of its affinity mask, or fewer under a control group's CPU quota.
int allowed_threads();

}  // namespace umbrix::app
