#!/bin/sh
# Makes the finite-element references (the CSV files beside this script) again: about an hour on one core, 2 GB.
# usage: make.sh [folder for decks and results, kept, so that a second call only solves what changed] [case ...]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:-"$here/../../../build-references"}
[ $# -gt 0 ] && shift
missing=""
for package in calculix-ccx gmsh python3-numpy python3-scipy; do
    dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
done
if [ -n "$missing" ]; then
    # shellcheck disable=SC2086  # one word for each package
    $([ "$(id -u)" -eq 0 ] || echo sudo) apt-get install -y --no-install-recommends $missing
fi
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$here"
[ $# -gt 0 ] || set -- cylinder_compression cylinder_shear extension indentation cylinder_compression_nu0499 brain cut_path cut_block wet_block wet_ball septum_block bilayer disc
for case in "$@"; do
    nice -n 5 /usr/bin/python3 -B -m "fe.$case" "$folder" .
done
/usr/bin/python3 -B -m fe.check
