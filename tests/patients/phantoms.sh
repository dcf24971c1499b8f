#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Whether the 95 % ellipsoids of <uncertainty> hold the truth on the program's own head, by the distance from the nearest
# measured point. Writes coverage.md. Ends with 1 when the share is not within 90 to 98 %.
#
#   bash tests/patients/phantoms.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

usage="usage: bash tests/patients/phantoms.sh [--out DIR]"
out=$root/build/phantoms_coverage
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=${2:?$usage}; shift 2 ;;
    *) echo "$usage" >&2; exit 2 ;;
  esac
done
install_packages python3 python3-numpy >&2
program=${BRAINSHIFT:-$(built_program)}
/usr/bin/python3 "$root/tests/patients/phantoms.py" "$program" "$out"
