#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The main job on a real head, from a fresh Debian 12: installs what is missing, builds, runs, says where the report is.
#
#   bash pipelines/demo.sh [--out DIR] [--preset fast|balanced|accurate] [--no-install]
#
# The head is the MRI "Colin 27" of Debian's mricron-data, with a simulated craniotomy. Where that package cannot be had,
# a synthetic head takes its place.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
out=$root/demo
install=yes
preset=()

usage() {
  echo "usage: bash pipelines/demo.sh [--out DIR] [--preset fast|balanced|accurate] [--no-install]"
}

while [ $# -gt 0 ]; do
  case $1 in
    --out)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      out=$2
      shift 2
      ;;
    --preset)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      preset=(--preset "$2")
      shift 2
      ;;
    --no-install)
      install=no
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "demo.sh: unknown argument '$1'" >&2
      usage >&2
      exit 2
      ;;
  esac
done

[ $install = no ] || install_packages
build "$root/build" brainshift -DCMAKE_BUILD_TYPE=Release
brainshift=$root/build/pipelines/brainshift

head=$(dpkg -L mricron-data 2>/dev/null | grep '/ch2\.nii\.gz$' || true)
mask=$(dpkg -L mricron-data 2>/dev/null | grep '/ch2bet\.nii\.gz$' || true)

if [ -n "$head" ] && [ -r "$head" ] && [ -n "$mask" ] && [ -r "$mask" ]; then
  echo "The head: $head (a real MRI); the craniotomy on it is simulated."
  "$brainshift" run "$root/pipelines/scenes/colin27.xml" --out "$out" \
    --set "image.t1=$head" --set "image.brain_mask=$mask" "${preset[@]}"
else
  echo "The head MRI of mricron-data is not there: a synthetic head takes its place."
  "$brainshift" phantom --out "$out/phantom"
  "$brainshift" run "$out/phantom/scene.xml" --out "$out" "${preset[@]}"
fi

echo
echo "Done. The report: $(cd "$out" && pwd)/report/index.html"
