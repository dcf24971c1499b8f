# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by run.sh of verification and extremes.
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/setup.sh"

# run_table FOLDER PROGRAM [--out DIR] [CASE ...]: builds what is missing and runs the program of tests/FOLDER.
run_table() {
  local folder=$1 program=$2
  local out=$root/build/$folder
  shift 2
  if [ "${1:-}" = --out ]; then
    out=${2:?usage: bash tests/$folder/run.sh [--out DIR] [CASE ...]}
    shift 2
  fi
  install_packages >&2
  build "$root/build" "$program" -DBRAINSHIFT_TESTS=ON -DCMAKE_BUILD_TYPE=Release >&2
  "$root/build/tests/$folder/$program" --out "$out" "$@"
}
