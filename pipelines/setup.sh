# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the scripts that build, as demo.sh and tests/run.sh: installs what a fresh Debian 12 lacks, and builds.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

missing_packages() {
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
    echo "run this as root, to install packages: $*" >&2
    return 1
  fi
}

# The two libraries of the report's view, whose checksums viewer.cmake has.
viewer_is_here() {
  [ -e "$root/build/npm/niivue-niivue-0.69.0.tgz" ] && [ -e "$root/build/npm/uplot-1.6.32.tgz" ]
}

fetch_viewer() {
  local folder=$root/build/npm packages=(@niivue/niivue@0.69.0 uplot@1.6.32)
  mkdir -p "$folder"
  (cd "$folder" && npm pack --silent --fetch-retries=0 --fetch-timeout=60000 "${packages[@]}") ||
    echo "${packages[*]} cannot be had by npm: the report will not turn."
}

# The packages of packages.txt and those named. What may fail to come: the head MRI, in whose place a synthetic head is
# taken, and the report's view, or npm, which brings it: the report then does not turn.
install_packages() {
  local needed wanted=(mricron-data) package
  mapfile -t needed < <(missing_packages $(grep -v '^#' "$root/pipelines/packages.txt") "$@")
  viewer_is_here || command -v npm > /dev/null || wanted+=(npm)
  mapfile -t wanted < <(missing_packages "${wanted[@]}")
  if [ $((${#needed[@]} + ${#wanted[@]})) -gt 0 ]; then
    echo "Installing: ${needed[*]} ${wanted[*]}"
    as_root apt-get update || true # packages may still come from the cache; installing says whether they do
    local apt=(env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends)
    [ ${#needed[@]} = 0 ] || as_root "${apt[@]}" "${needed[@]}"
    for package in "${wanted[@]}"; do
      as_root "${apt[@]}" "$package" || echo "$package cannot be had."
    done
  fi
  viewer_is_here || fetch_viewer
}

# How many processors may be used. nproc alone answers with OMP_NUM_THREADS where that is set.
processors() { env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc; }

# build FOLDER TARGET [cmake options]: a compiler that reads CGAL and ITK takes up to 2 GB.
build() {
  local folder=$1 target=$2 jobs room
  shift 2
  jobs=$(processors)
  room=$(awk '/MemAvailable/ { print int($2 / 2000000) }' /proc/meminfo)
  [ "$room" -ge "$jobs" ] || jobs=$((room > 0 ? room : 1))
  cmake -S "$root" -B "$folder" -G Ninja "$@"
  cmake --build "$folder" --target "$target" --parallel "$jobs"
}

# Builds this checkout's program and prints its path.
built_program() { build "$root/build" brainshift -DCMAKE_BUILD_TYPE=Release >&2 && echo "$root/build/pipelines/brainshift"; }
