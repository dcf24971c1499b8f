#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What is left in the brain of a load that has more wrong with it than noise, on the program's own head: an unknown
# registration, points that contradict the others, and what a run to a tolerance makes of noise. Writes faults.md.
#
#   bash tests/patients/faults.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/own_head.sh"

more=()
on_own_head faults "$root/build/faults" "$@"
