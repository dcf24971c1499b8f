#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the library into a temporary prefix, builds the examples against it as a stranger would, and runs them: by
# the commands of the tutorials' blocks marked ```sh, which need an installed library. Builds README.md's program, too.
#
#   bash tests/structure/install_test.sh BUILD SOURCE
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# blocks WORD PAGE: the lines of the blocks behind fences with that word.
blocks() {
  awk -v fence='```'"$1" '/^```/ { inside = !inside && $0 == fence; next } inside { print }' "$2"
}

# The clone that the tutorials speak of, with its build.
mkdir brainshift
ln -s "$source/pipelines" brainshift/pipelines
ln -s "$build" brainshift/build
for page in new-material swap-discretiser; do
  blocks sh "$source/pipelines/tutorials/$page.md" >commands.sh
  [ -s commands.sh ] || { echo "$page.md: no block marked sh" >&2; exit 1; }
  bash -euo pipefail commands.sh
done

prefix/bin/brainshift phantom --size 48 --out head
my_examples/build/chain head/t1.nii.gz head/labels.nii.gz head/craniotomy.csv chain
test -s chain/warped.nii.gz

mkdir readme
{
  grep -h '^#include "' "$source/pipelines/examples/chain.cpp"
  echo 'int main() {'
  blocks cpp "$source/README.md"
  echo '}'
} >readme/readme.cpp
cat >readme/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(readme LANGUAGES CXX)
find_package(brainshift REQUIRED)
add_executable(readme readme.cpp)
target_link_libraries(readme PRIVATE brainshift::segmentation brainshift::registration)
END
cmake -S readme -B readme/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix"
cmake --build readme/build
readme/build/readme
test -s head/warped.nii.gz
