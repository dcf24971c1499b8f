#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What it brings to say how well the points of a load were measured: the error that noise leaves in the brain, beside
# the same points imposed exactly, on the program's own head and the demo's. Writes noise.md. Takes over an
# hour beside other work.
#
#   bash tests/patients/noise.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/own_head.sh"

more=("$root/pipelines/scenes/colin27.xml")
on_own_head noise "$root/build/noise" "$@"
