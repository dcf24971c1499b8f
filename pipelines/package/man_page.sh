#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A manual page, made of what a command says of itself:  man_page.sh HELP2MAN COMMAND SENTENCE OUT.1.gz
set -euo pipefail
# Lines of argparse are not broken: a word broken at its own hyphen would lose it.
COLUMNS=500 "$1" --no-info --section=1 --name="$3" "$2" | gzip -9n >"$4.partial"
mv "$4.partial" "$4"
