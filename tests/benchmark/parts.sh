#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What each part of a model costs when it is there and when it is not: prints the table and writes build/benchmark/parts.csv.
# Needs what `bash tests/run.sh` builds.
#
#   bash tests/benchmark/parts.sh [--build DIR] [NODES [REPEATS]]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build
if [ "${1:-}" = --build ]; then
  build=$2
  shift 2
fi
export OMP_WAIT_POLICY=passive
mkdir -p "$root/build/benchmark"
"$build/tests/benchmark/parts" "$root/build/benchmark/parts.csv" "$@"
