#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the library into a temporary prefix, builds the examples against it as a stranger would, and runs them.
#
#   bash tests/structure/install_test.sh BUILD SOURCE
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
cp -r "$source/pipelines/examples" "$scratch/examples"
cd "$scratch"
cmake -S examples -B examples/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix"
cmake --build examples/build
prefix/bin/brainshift phantom --size 48 --out head
examples/build/chain head/t1.nii.gz head/labels.nii.gz head/craniotomy.csv out
test -s out/warped.nii.gz
examples/build/own_law
examples/build/own_cloud
test -s out/solution.vtu
