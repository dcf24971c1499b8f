#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Holds what brainshift-bids writes against BIDS: an OUT of its own by the validator of the standard's schema, which npm's
# package bids-validator brings beside its older command and which runs in Deno; and one in BIDS_DIR/derivatives by that
# command, which knows raw data alone. Both want npm's packages.
#
#   bash tests/bids/validate.sh [--out DIR]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

out=$root/build/bids_validate
case ${1:-} in
  '') ;;
  --out) out=$(realpath -m "$2") ;;
  *) sed -n '/^#   bash/s/^#   /usage: /p' "$0" >&2; exit 2 ;;
esac
program=${BRAINSHIFT:-}
if [ -z "$program" ]; then
  build "$root/build" brainshift -DCMAKE_BUILD_TYPE=Release >&2
  program=$root/build/pipelines/brainshift
fi
mkdir -p "$out/npm"
npm install --prefix "$out/npm" --no-audit --no-fund --silent bids-validator@1.15.0 deno@2
by_schema() { # FOLDER
  "$out/npm/node_modules/.bin/deno" run --allow-all --cached-only \
    "$out/npm/node_modules/bids-validator/dist/validator/bids-validator.js" "$1"
}

python3 "$root/tests/bids/make_cohort.py" "$program" "$out/bids" 2 0
rm -rf "$out/derived"
for folder in "$out/derived" "$out/bids/derivatives/brainshift"; do
  "$root/pipelines/bids/brainshift-bids" "$out/bids" "$folder" participant --quiet --one-job --brainshift "$program" \
    --set discretise.nodes=200 --set segment.edge_length=12
done
by_schema "$out/derived"
"$out/npm/node_modules/.bin/bids-validator" "$out/bids"
# A validator that saw no file would pass all: a wrong name must be found.
wrong=$out/derived/sub-00001/anat/sub-00001_space-intraop_desc-wrong_T2.nii.gz
touch "$wrong"
if by_schema "$out/derived" > "$out/wrong.txt"; then
  echo "validate.sh: the schema's validator does not see $wrong" >&2
  exit 1
fi
echo "Both validators found no error, and the schema's found a wrong name."
