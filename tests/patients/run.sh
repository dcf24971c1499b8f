#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Landmark pairs of patients: six pairs of each file go in, the others are predicted beside predictors that know no
# mechanics. FOLDER holds RESECT's Case*-MRI-beforeUS.tag (Xiao et al. 2017, Med Phys 44:3875, CC BY 4.0). Writes
# patients.csv and residuals.svg. Ends with 1 when the model does patients harm (README.md says when).
#
#   bash tests/patients/run.sh FOLDER [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

usage="usage: bash tests/patients/run.sh FOLDER [--out DIR]"
out=$root/build/patients folder=
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=${2:?$usage}; shift 2 ;;
    -*) echo "$usage" >&2; exit 2 ;;
    *) folder=$1; shift ;;
  esac
done
[ -d "$folder" ] || { echo "$usage" >&2; exit 2; }
install_packages python3 python3-numpy >&2
program=${BRAINSHIFT:-$(built_program)}
/usr/bin/python3 "$root/tests/patients/patients.py" "$program" "$out" "$folder"
