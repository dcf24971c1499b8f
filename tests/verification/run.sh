#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The verification table: every case against its analytic or finite-element reference. Builds what is missing, prints the
# table, writes it as verification.md and verification.csv with the curves as SVG, and exits 1 when a figure is worse than
# its bound. The references are committed; references/make.sh makes them again.
#
#   bash tests/verification/run.sh [--out DIR] [CASE ...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../table.sh"

run_table verification verify "$@"
