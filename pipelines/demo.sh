#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The main job on a real head, from a fresh Debian 12: installs what is missing, builds, runs, says where the report is.
#
#   bash pipelines/demo.sh [--out DIR] [--no-install]
#
# The head is the MRI "Colin 27" of Debian's mricron-data, with a simulated craniotomy. Where that package cannot be had,
# a synthetic head takes its place.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$root/demo
install=yes

usage() {
  echo "usage: bash pipelines/demo.sh [--out DIR] [--no-install]"
}

while [ $# -gt 0 ]; do
  case $1 in
    --out)
      [ $# -ge 2 ] || { usage >&2; exit 2; }
      out=$2
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

missing() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "demo.sh: run this as root, to install packages: $*" >&2
    return 1
  fi
}

install_packages() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

if [ $install = yes ]; then
  mapfile -t packages < <(grep -v '^#' "$root/pipelines/packages.txt")
  mapfile -t needed < <(missing "${packages[@]}")
  mapfile -t image < <(missing mricron-data)
  if [ $((${#needed[@]} + ${#image[@]})) -gt 0 ]; then
    echo "Installing: ${needed[*]} ${image[*]}"
    as_root apt-get update || true # packages may still come from the cache; installing says whether they do
  fi
  [ ${#needed[@]} = 0 ] || install_packages "${needed[@]}"
  [ ${#image[@]} = 0 ] || install_packages "${image[@]}" || echo "mricron-data cannot be had."
fi

# A compiler that reads CGAL and ITK takes up to 2 GB.
jobs=$(nproc)
room=$(awk '/MemAvailable/ { print int($2 / 2000000) }' /proc/meminfo)
[ "$room" -ge "$jobs" ] || jobs=$((room > 0 ? room : 1))

cmake -S "$root" -B "$root/build" -G Ninja -DCMAKE_BUILD_TYPE=Release
cmake --build "$root/build" --target brainshift --parallel "$jobs"
brainshift=$root/build/pipelines/brainshift

head=$(dpkg -L mricron-data 2>/dev/null | grep '/ch2\.nii\.gz$' || true)
mask=$(dpkg -L mricron-data 2>/dev/null | grep '/ch2bet\.nii\.gz$' || true)

if [ -n "$head" ] && [ -r "$head" ] && [ -n "$mask" ] && [ -r "$mask" ]; then
  echo "The head: $head (a real MRI); the craniotomy on it is simulated."
  "$brainshift" run "$root/pipelines/scenes/colin27.xml" --out "$out" \
    --set "image.t1=$head" --set "image.brain_mask=$mask"
else
  echo "The head MRI of mricron-data is not there: a synthetic head takes its place."
  "$brainshift" phantom --out "$out/phantom"
  "$brainshift" run "$out/phantom/scene.xml" --out "$out"
fi

echo
echo "Done. The report: $(cd "$out" && pwd)/report/index.html"
