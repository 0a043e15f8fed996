#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# All frames from their tiles; submit.sh submits it.
set -euo pipefail
exec srun umbrix merge -o "$1" --frames="$2" --tiles "$3" --overwrite
