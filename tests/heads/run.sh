#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A table of heads: every head of each folder's heads.tsv (columns head, t1, labels, brain_mask, tumour; a mask may be
# the skull-stripped T1 itself) from its files to warped images with no option set. The opening is simulated at the same
# place of each head. Writes heads.csv, heads.md and a page index.html, outliers first, and a run's folder a head with
# its report. Ends with 1 when a row misses a bound.
#
# --quick is for the gate: 2000 nodes, and no time is judged.
#
#   bash tests/heads/run.sh [--quick] [--out DIR] FOLDER...
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

usage="usage: bash tests/heads/run.sh [--quick] [--out DIR] FOLDER..."
out=$root/build/heads
quick=()
while [[ ${1:-} == --* ]]; do
  case $1 in
    --quick) quick=(--quick) ;;
    --out)
      out=${2:?$usage}
      shift
      ;;
    *)
      echo "$usage" >&2
      exit 2
      ;;
  esac
  shift
done
[ $# -gt 0 ] || { echo "$usage" >&2; exit 2; }
[ -n "${BRAINSHIFT:-}" ] || install_packages python3 >&2
program=${BRAINSHIFT:-$(built_program)}
python3 "$root/tests/heads/heads.py" "${quick[@]}" "$program" "$out" "$@"
