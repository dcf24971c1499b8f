#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The verification table: every case against its analytic or finite-element reference. Builds what is missing, prints the
# table, writes it as verification.md and verification.csv with the curves as SVG, and exits 1 when a figure is worse than
# its bound. The references are committed; references/make.sh makes them again.
#
#   bash tests/verification/run.sh [--out DIR] [CASE ...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

out=$root/build/verification
if [ "${1:-}" = --out ]; then
  out=${2:?usage: bash tests/verification/run.sh [--out DIR] [CASE ...]}
  shift 2
fi
install_packages >&2
build "$root/build" verify -DCMAKE_BUILD_TYPE=Release >&2
"$root/build/tests/verification/verify" --out "$out" "$@"
