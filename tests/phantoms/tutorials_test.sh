#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs every command of the tutorials as a reader would: the ```bash blocks of a page one after the other, in a folder
# of its own. Blocks for an installed library are marked ```sh: tests/structure/install_test.sh runs those.
#
#   bash tests/phantoms/tutorials_test.sh PROGRAM TUTORIALS
set -euo pipefail
program=$(realpath "$1")
tutorials=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin"
ln -s "$program" "$scratch/bin/brainshift"
export PATH=$scratch/bin:$PATH OMP_WAIT_POLICY=passive
for page in "$tutorials"/*.md; do
  name=$(basename "$page" .md)
  # A block without a word, or with one that nobody runs, would be a command that no test sees.
  if grep -nE '^```' "$page" | grep -vE ':```(bash|sh|cpp)?$'; then
    echo "$page: the fences above are neither bash, sh nor cpp" >&2
    exit 1
  fi
  awk -v page="$name.md" '
    /^```/ { if (open) open = run = 0; else { open = 1; run = $0 == "```bash"
             if ($0 == "```") { print page ":" NR ": a block without a word" > "/dev/stderr"; exit 1 }
             if (run) print "echo \"== " page ", line " NR "\"" }
             next }
    run { print }' "$page" >"$scratch/$name.sh"
  [ -s "$scratch/$name.sh" ] || { echo "$page: no command to run" >&2; exit 1; }
  mkdir "$scratch/$name"
  (cd "$scratch/$name" && bash -euo pipefail "$scratch/$name.sh") || { echo "$page: failed" >&2; exit 1; }
done
