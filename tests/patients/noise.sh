#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What it brings to say how well the points of a load were measured: the error that noise leaves in the brain, beside
# the same points imposed exactly, on the program's own head and the demo's. Writes noise.md. Takes a quarter of an hour.
#
#   bash tests/patients/noise.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

usage="usage: bash tests/patients/noise.sh [--out DIR]"
out=$root/build/noise
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=${2:?$usage}; shift 2 ;;
    *) echo "$usage" >&2; exit 2 ;;
  esac
done
install_packages mricron-data python3 python3-numpy >&2
program=${BRAINSHIFT:-$(built_program)}
/usr/bin/python3 "$root/tests/patients/noise.py" "$program" "$out" "$root/pipelines/scenes/colin27.xml"
