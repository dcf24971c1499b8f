#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the program costs, beside what the machine can do and beside other programs on the same work: prints the tables and
# writes them as build/benchmark/benchmark.md and *.csv. From a fresh Debian 12: installs what is missing and builds.
#
#   bash tests/benchmark/run.sh [--full] [--quick] [--native] [--no-install] [TABLE ...]
#
# TABLE: machine kernels scale stages brain resample; all if none is named. --full: a cloud of a million nodes and
# CalculiX's slow solvers, too. --quick: small bodies and few repetitions, to see that all runs. --native: the kernels in a
# build for this processor as well. A table that is not named stays as an earlier run left it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

here=$root/tests/benchmark
out=$root/build/benchmark
size=usual
native=no
install=yes
tables=()
while [ $# -gt 0 ]; do
  case $1 in
    --full) size=full ;;
    --quick) size=quick ;;
    --native) native=yes ;;
    --no-install) install=no ;;
    machine | kernels | scale | stages | brain | resample) tables+=("$1") ;;
    *)
      sed -n 's/^#   bash/usage: bash/p' "$0" >&2
      exit 2
      ;;
  esac
  shift
done
[ $size != quick ] || out=$root/build/benchmark-quick # not among figures that count
[ ${#tables[@]} -gt 0 ] || tables=(machine kernels scale stages brain resample)

[ $install = no ] || install_packages libbenchmark-dev calculix-ccx gmsh elastix plastimatch python3-numpy python3-scipy time >&2
build "$root/build" benchmarks -DBRAINSHIFT_TESTS=ON -DCMAKE_BUILD_TYPE=Release >&2
[ $native = no ] || build "$root/build-native" kernels -DBRAINSHIFT_TESTS=ON -DBRAINSHIFT_NATIVE=ON -DCMAKE_BUILD_TYPE=Release >&2

export OMP_WAIT_POLICY=passive # as the program is meant to run beside others
export PYTHONDONTWRITEBYTECODE=1
brainshift=$root/build/pipelines/brainshift
work=$out/work
mkdir -p "$work"

# The demo's head, or the synthetic one where it cannot be had.
scene=$root/pipelines/scenes/colin27.xml
if [ $size = quick ] || [ ! -r "$(dpkg -L mricron-data 2>/dev/null | grep '/ch2\.nii\.gz$')" ]; then
  [ -d "$work/phantom" ] || "$brainshift" phantom --out "$work/phantom" >&2
  scene=$work/phantom/scene.xml
fi

programs() {
  echo "$1 ..." >&2
  shift
  "$@" >&2
}

# brain NAME CELLS_PER_NODE: a run of the scene's, discretised.
brain() {
  local nodes=20000
  [ $size != quick ] || nodes=2000
  "$brainshift" run "$scene" --out "$work/$1" --until discretise --quiet --set discretise.nodes=$nodes \
    --set "discretise.cells_per_node=$2"
}

machine() {
  local seconds=1.5
  [ $size != quick ] || seconds=0.1
  programs machine "$root/build/tests/benchmark/machine" "$out/machine.csv" $seconds
}

kernels() {
  local options=(--benchmark_min_time=0.3 --benchmark_repetitions=5 --benchmark_out_format=csv)
  [ $size != quick ] || options=(--benchmark_min_time=0.01 --benchmark_out_format=csv)
  brain published 1.9
  brain usual 0.75
  local folder
  rm -f "$out"/kernels*.csv
  for folder in build build-native; do
    [ $folder = build ] || [ $native = yes ] || continue
    programs "kernels, $folder" "$root/$folder/tests/benchmark/kernels" --runs "$scene" "$work/published" "$work/usual" \
      "${options[@]}" "--benchmark_out=$out/kernels${folder#build}.csv"
  done
}

scale() {
  local sizes=(10000 30000 100000) nodes
  [ $size != quick ] || sizes=(1000 3000)
  [ $size != full ] || sizes+=(1000000)
  rm -f "$out/scale.csv"
  for nodes in "${sizes[@]}"; do
    programs "scale, $nodes nodes" "$root/build/tests/benchmark/scale" "$out/scale.csv" "$nodes"
  done
}

stages() {
  local presets=default,fast,balanced,accurate
  [ $size != quick ] || presets=fast
  programs stages /usr/bin/python3 "$here/stages.py" "$out/stages.csv" "$work/stages" "$brainshift" "$scene" $presets
}

peers_brain() {
  programs brain /usr/bin/python3 "$here/peers/brain.py" "$out/brain.csv" "$work/brain" "$brainshift" \
    "$root/build/tests/benchmark/brain_load" $size
}

# On the scene's own image, with the field of a fast run.
peers_resample() {
  local t1
  "$brainshift" run "$scene" --out "$work/field" --preset fast --until register --quiet
  t1=$(/usr/bin/python3 -c 'import json, sys; print(next(i["path"] for i in json.load(open(sys.argv[1]))["inputs"] if i["role"] == "image.t1"))' \
    "$work/field/run.json")
  programs resample /usr/bin/python3 "$here/peers/resample.py" "$out/resample.csv" "$work/resample" \
    "$root/build/tests/benchmark/resample" "$t1" "$work/field/register/intraop_to_preop.nii.gz"
}

for table in "${tables[@]}"; do
  case $table in
    brain | resample) "peers_$table" ;;
    *) "$table" ;;
  esac
done
/usr/bin/python3 "$here/report.py" "$out" $size
echo "The tables: $out/benchmark.md" >&2
