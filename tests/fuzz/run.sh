#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Our readers under libFuzzer: no crash, no input over 10 s or 2 GB. What breaks one is left in the folder that it
# starts in, as crash-..., and goes to tests/fuzz/corpus/READER with the repair.
#
#   cmake -B build-fuzz -DBRAINSHIFT_TESTS=ON -DBRAINSHIFT_FUZZ=ON -DBRAINSHIFT_SANITIZE=ON -DCMAKE_BUILD_TYPE=Debug \
#     -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 && cmake --build build-fuzz --target fuzz_readers
#   bash tests/fuzz/run.sh build-fuzz/tests/fuzz/fuzz_readers SECONDS [READER...]
set -euo pipefail
program=$(realpath "$1")
seconds=$2
shift 2
corpus=$(dirname "$(realpath "${BASH_SOURCE[0]}")")/corpus
[ $# -gt 0 ] || set -- $(ls "$corpus")
# The inputs go through files, best through those that no disk sees.
[ -w /dev/shm ] && export TMPDIR=/dev/shm
found=$(mktemp -d)
trap 'rm -rf "$found"' EXIT
for reader in "$@"; do
  mkdir "$found/$reader"
  echo "== $reader"
  # Only what is new is written, and not to the corpus.
  TMPDIR=$found "$program" --reader="$reader" "$found/$reader" "$corpus/$reader" -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=2048 -max_len=16384 -print_final_stats=1 -verbosity=1 2>"$found/log" ||
    { cat "$found/log"; exit 1; }
  grep -E 'number_of_executed_units|slowest_unit|peak_rss' "$found/log"
done
