#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds pipelines/bids/Dockerfile by buildah and runs the BIDS App in it, as another user than root, on two phantoms.
# No registry of images is asked: mmdebstrap makes the image of Debian that the recipe begins with, and apt of this
# machine, a Debian 12, brings the packages, so that the build itself needs no network. Wants to be root.
#
#   bash tests/bids/container.sh [--out DIR] [--package FILE.deb] [--no-install]
#
# --package leaves out the recipe's first stage, which compiles, and takes a package that is there already.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

out=$root/build/container package='' install=yes
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$2; shift ;;
    --package) package=$(realpath "$2"); shift ;;
    --no-install) install=no ;;
    *) sed -n '/^#   bash/s/^#   /usage: /p' "$0" >&2; exit 2 ;;
  esac
  shift
done
[ "$(id -u)" = 0 ] || { echo "container.sh: mmdebstrap and buildah's chroot want to be root" >&2; exit 2; }
[ $install = no ] || install_packages buildah crun mmdebstrap dpkg-dev
mkdir -p "$out"
out=$(realpath "$out")
own_buildah() {
  local command=$1
  shift
  buildah --root "$out/store" --runroot "$out/run" "$command" "$@"
}

# What the recipe installs, with all that it needs, as a folder that apt reads.
fetch_packages() { # PACKAGE...
  local nothing=$out/nothing_is_installed
  mkdir -p "$out/debs/partial"
  : > "$nothing"
  apt-get --quiet update
  apt-get -o Dir::State::status="$nothing" -o Dir::Cache::archives="$out/debs" -o APT::Keep-Downloaded-Packages=true \
    --quiet --yes --no-install-recommends --download-only install "$@"
  (cd "$out/debs" && dpkg-scanpackages --multiversion . > Packages 2>/dev/null)
}

make_debian() {
  [ -e "$out/debian.tar" ] || mmdebstrap --variant=minbase bookworm "$out/debian.tar"
  local image
  image=$(own_buildah from scratch)
  own_buildah add --quiet "$image" "$out/debian.tar" /
  own_buildah run --isolation chroot "$image" -- sh -c \
    'rm -f /etc/apt/sources.list.d/*; echo "deb [trusted=yes] file:/debs ./" > /etc/apt/sources.list'
  for tag in bookworm bookworm-slim; do
    own_buildah commit --quiet "$image" "docker.io/library/debian:$tag"
  done
  own_buildah rm "$image"
}

run_app() { # WORD... ; in a container of the image, as docker run does with --user and --volume
  own_buildah run --isolation chroot --user 1234:1234 --volume "$out/study:/study" --volume "$out/study/bids:/bids:ro" \
    --volume "$root/tests/bids:/tests:ro" "$container" -- "$@"
}

installs='s/.*apt-get install --yes --no-install-recommends//p'
begin=1 first_stage=()
[ -z "$package" ] || begin='/^FROM debian:bookworm-slim/'
mapfile -t wanted < <(sed -n "$begin,\$ $installs" "$root/pipelines/bids/Dockerfile" | tr ' ' '\n' | grep '^[a-z]')
if [ -n "$package" ]; then
  mapfile -t -O ${#wanted[@]} wanted < <(dpkg-deb --field "$package" Depends | sed 's/([^)]*)//g; s/:any//g' | tr -d ' ' |
    tr ',' '\n')
  mkdir -p "$out/first_stage/packages"
  cp "$package" "$out/first_stage/packages/"
  first_stage=(--build-context "build=$out/first_stage")
else
  mapfile -t -O ${#wanted[@]} wanted < <(grep -v '^#' "$root/pipelines/packages.txt"
    sed -n 's/.*install_packages //p' "$root/pipelines/package/package.sh" | tr ' ' '\n')
fi
fetch_packages "${wanted[@]}"
make_debian
own_buildah build --isolation chroot --pull-never --volume "$out/debs:/debs:ro" "${first_stage[@]}" \
  --file "$root/pipelines/bids/Dockerfile" --tag brainshift "$root"

rm -rf "$out/study"
mkdir -m 777 "$out/study" "$out/study/bids"
container=$(own_buildah from --pull-never brainshift)
run_app python3 /tests/make_cohort.py brainshift /study/bids 2 0
# What buildah runs is not the image's ENTRYPOINT, which docker begins with.
entry=$(own_buildah inspect --format '{{index .OCIv1.Config.Entrypoint 0}}' brainshift)
run_app "$entry" /bids /study/out participant --set discretise.nodes=300 --set segment.edge_length=11
own_buildah rm "$container"
test -s "$out/study/out/group.html"
echo "The image is built and the App ran in it: $out/study/out/group.html"
