#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What is left in the brain of a load that has more wrong with it than noise, on the program's own head: an unknown
# registration, points that contradict the others, and what a run to a tolerance makes of noise. Writes faults.md.
#
#   bash tests/patients/faults.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

usage="usage: bash tests/patients/faults.sh [--out DIR]"
out=$root/build/faults
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=${2:?$usage}; shift 2 ;;
    *) echo "$usage" >&2; exit 2 ;;
  esac
done
install_packages python3 python3-numpy >&2
program=${BRAINSHIFT:-$(built_program)}
/usr/bin/python3 "$root/tests/patients/faults.py" "$program" "$out"
