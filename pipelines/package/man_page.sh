#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The manual page, made of what the program says of itself:  man_page.sh HELP2MAN PROGRAM OUT.1.gz
set -euo pipefail
"$1" --no-info --section=1 --name="computes how the brain moved in an operation and warps its MRI" \
  --no-discard-stderr "$2" | gzip -9n >"$3"
