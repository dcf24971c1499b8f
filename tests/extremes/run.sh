#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Stability at the extremes: what the solver makes of loads, materials, clouds, places and steps at or beyond the ends of
# what it is for. A right answer, or a stop or refusal that says why; never a wrong answer that looks right. Builds what
# is missing, prints the table, writes it as extremes.md and extremes.csv and exits 1 when a row does not do what it must.
#
#   bash tests/extremes/run.sh [--out DIR] [CASE ...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../table.sh"

run_table extremes extremes "$@"
