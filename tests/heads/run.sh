#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A table of heads: every head of each folder's heads.tsv (columns head, t1, labels, brain_mask, tumour; a mask may be
# the skull-stripped T1 itself) from its files to warped images with no option set. The opening is simulated at the same
# place of each head. Writes heads.csv and heads.md, outliers first, and a run's folder a head with its report. Ends
# with 1 when a row misses a bound.
#
#   bash tests/heads/run.sh [--out DIR] FOLDER...
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

out=$root/build/heads
if [ "${1:-}" = --out ]; then
  out=${2:?usage: bash tests/heads/run.sh [--out DIR] FOLDER...}
  shift 2
fi
[ $# -gt 0 ] || { echo "usage: bash tests/heads/run.sh [--out DIR] FOLDER..." >&2; exit 2; }
program=${BRAINSHIFT:-}
if [ -z "$program" ]; then
  install_packages python3 >&2
  build "$root/build" brainshift -DCMAKE_BUILD_TYPE=Release >&2
  program=$root/build/pipelines/brainshift
fi
python3 "$root/tests/heads/heads.py" "$program" "$out" "$@"
