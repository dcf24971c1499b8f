# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by noise.sh, faults.sh and phantoms.sh: what they take from the command line, and how they run.

source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

# NAME OUT ARGUMENT...: runs NAME.py with the program, the folder of --out, else OUT, and `more`, where that is set.
on_own_head() {
  local name=$1 out=$2 usage="usage: bash tests/patients/$1.sh [--out DIR]"
  shift 2
  while [ $# -gt 0 ]; do
    case $1 in
      --out) out=${2:?$usage}; shift 2 ;;
      *) echo "$usage" >&2; exit 2 ;;
    esac
  done
  install_packages python3 python3-numpy >&2
  local program=${BRAINSHIFT:-$(built_program)}
  /usr/bin/python3 "$root/tests/patients/$name.py" "$program" "$out" "${more[@]}"
}
