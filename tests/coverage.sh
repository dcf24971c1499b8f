#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Which lines the tests run, folder by folder: builds with gcov's counters, runs the tests and asks gcovr.
#
#   bash tests/coverage.sh [--no-install] [--unit]     --unit: the unit tests alone
#
# Ends with 1 where a folder is below 90 % and not in the list of tests/README.md, which says why.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/setup.sh"
install=yes
tests=()
while [ $# -gt 0 ]; do
  case $1 in
    --no-install) install=no ;;
    --unit) tests=(--label-regex unit) ;;
    *)
      echo "usage: bash tests/coverage.sh [--no-install] [--unit]" >&2
      exit 2
      ;;
  esac
  shift
done
[ $install = no ] || install_packages libbenchmark-dev python3 gcovr

export OMP_WAIT_POLICY=passive OMP_NUM_THREADS=1
# Threads that count a line at once may lose a count, not a line. The libraries' templates go without counters and
# checks of their own: their loops are most of the time.
ours="$root/(segmentation|discretise|solve|register|pipelines)/.*"
build "$root/build-coverage" all -DBRAINSHIFT_TESTS=ON -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG="-O1 -DNDEBUG --coverage -fprofile-update=single -fprofile-filter-files='$ours'"
find "$root/build-coverage" -name '*.gcda' -delete
ctest --test-dir "$root/build-coverage" "${tests[@]}" --exclude-regex 'structure|benchmark' --parallel "$(processors)" ||
  echo "Some tests failed; what they ran is counted."
# A lost count can make a branch's negative, which gcovr would refuse.
gcovr --root "$root" --object-directory "$root/build-coverage" --gcov-ignore-parse-errors --exclude 'tests/.*' \
  --exclude 'build.*' --exclude 'pipelines/examples/.*' --exclude-unreachable-branches \
  --json-summary "$root/build-coverage/coverage.json" 2>"$root/build-coverage/gcovr.log" ||
  { tail -n 3 "$root/build-coverage/gcovr.log" >&2 && exit 1; }
python3 "$root/tests/coverage_table.py" "$root/build-coverage/coverage.json" "$root/tests/README.md"
