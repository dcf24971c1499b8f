#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Random problems, judged: bodies, clouds, cells, tissues and loads of a seed, each solved by the program and once more
# otherwise. Writes DIR/problems.csv and DIR/problems.md; files of what is not good stay in DIR/SEED. Ends with 1 where
# a verdict is not good. A run that was stopped goes on where it was.
#
# --small is for the gate: fewer nodes, and anew each time. --laws makes two tissues in three Ogden's. --calculix takes
# CalculiX as the reference where it can.
#
#   bash tests/random/run.sh [--small] [--laws] [--calculix] [--count N] [--first SEED] [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

usage="usage: bash tests/random/run.sh [--small] [--laws] [--calculix] [--count N] [--first SEED] [--out DIR]"
out=$root/build/random
options=()
while [ $# -gt 0 ]; do
  case $1 in
    --small) options+=(--small --anew) ;;
    --calculix | --laws) options+=("$1") ;;
    --count | --first)
      options+=("$1" "${2:?$usage}")
      shift
      ;;
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
[ -n "${BRAINSHIFT:-}" ] || install_packages python3 >&2
program=${BRAINSHIFT:-$(built_program)}
python3 -B "$root/tests/random/random_problems.py" "$program" --out "$out" "${options[@]}"
