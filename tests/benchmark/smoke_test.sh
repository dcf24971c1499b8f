#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The benchmark's programs on tiny bodies: they run and their tables have rows. kernels is built where Google Benchmark is.
#
#   smoke_test.sh FOLDER MACHINE SCALE [KERNELS]
set -euo pipefail
folder=$1
rm -rf "$folder"
mkdir -p "$folder"

# rows FILE PATTERN LEAST: so many lines at least have the pattern.
rows() {
  local found
  found=$(grep -c "$2" "$1") || true
  [ "$found" -ge "$3" ] || {
    echo "$1 has $found rows with '$2', not $3" >&2
    exit 1
  }
}

"$2" "$folder/machine.csv" 0.01
rows "$folder/machine.csv" 'GB/s,1,[0-9]' 4
rows "$folder/machine.csv" 'GFLOP/s,1,[0-9]' 2

for nodes in 600 900; do
  "$3" "$folder/scale.csv" $nodes
done
rows "$folder/scale.csv" '^[0-9]' 2

if [ $# -ge 4 ]; then
  "$4" --benchmark_min_time=0.001 --benchmark_out="$folder/kernels.csv" --benchmark_out_format=csv
  for kernel in 'internal force' 'plain rows' 'neighbour search' 'shape functions' 'correction' 'essential' 'contact' 'neo-Hookean law' \
    'MMLS fit'; do
    rows "$folder/kernels.csv" "^\"$kernel.*; 1/.*,[0-9]" 1
  done
fi
