#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the choices of the demo change: runs the scene of the real head in variants and prints how far the displacements lie
# apart at the nodes, and whether the threads make any difference. Needs what `bash tests/run.sh` builds, and mricron-data.
#
#   bash tests/verification/demo_figures.sh [--build DIR] [--out DIR]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build
out=$root/build/demo_figures
while [ $# -ge 2 ]; do
  case $1 in
    --build) build=$2 ;;
    --out) out=$2 ;;
    *) break ;;
  esac
  shift 2
done
[ $# = 0 ] || { echo "usage: bash tests/verification/demo_figures.sh [--build DIR] [--out DIR]" >&2; exit 2; }

# solve NAME [options of run]: the scene up to the solution, in a folder of its own.
solve() {
  local name=$1
  shift
  "$build/pipelines/brainshift" run "$root/pipelines/scenes/colin27.xml" --out "$out/$name" --until solve --quiet "$@"
}

compare() {
  printf '%-58s ' "$1"
  "$build/tests/verification/compare_solutions" "$out/$2/solve/solution.vtu" "$out/$3/solve/solution.vtu"
}

solve balanced
solve tight --set solve.tolerance=0.005
solve tightest --set solve.tolerance=0.0001
solve linear --set solve.basis=linear
solve tetrahedra --set discretise.cells=tetrahedra
solve fine --set discretise.nodes=40000
solve one_thread --threads 1

compare 'stop tolerance 0.01 mm against 0.005 mm' balanced tight
compare 'stop tolerance 0.01 mm against 0.0001 mm' balanced tightest
compare 'linear MLS against quadratic MMLS' balanced linear
compare 'hexahedra against tetrahedra' balanced tetrahedra
compare '12,000 nodes against 40,000' balanced fine
compare 'one thread against all' balanced one_thread
cmp "$out/balanced/solve/solution.vtu" "$out/one_thread/solve/solution.vtu" &&
  echo 'solution.vtu is the same byte for byte with one thread and with all'
