#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Whether the 95 % ellipsoids of <uncertainty> hold the truth on the program's own head, by the distance from the nearest
# measured point. Writes coverage.md. Ends with 1 when the share is not within 90 to 98 %.
#
#   bash tests/patients/phantoms.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/own_head.sh"

more=()
on_own_head phantoms "$root/build/phantoms_coverage" "$@"
