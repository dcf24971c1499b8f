#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Holds what brainshift-bids writes, and the phantoms that it reads, against BIDS, by the validator of the standard's
# schema. npm's package bids-validator brings it, as one file beside its older command; it runs in Deno, which npm has,
# too.
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
program=${BRAINSHIFT:-$(built_program)}
mkdir -p "$out/npm"
(cd "$out/npm" && npm pack --silent bids-validator@1.15.0 && tar -xzf bids-validator-1.15.0.tgz &&
  npm install --no-audit --no-fund --silent deno@2)
validate() { # FOLDER; without the warnings of what is recommended of raw data alone
  "$out/npm/node_modules/.bin/deno" run --allow-all --cached-only "$out/npm/package/dist/validator/bids-validator.js" \
    --ignoreWarnings "$1"
}

/usr/bin/python3 "$root/tests/bids/make_cohort.py" "$program" "$out/bids" 2 0
rm -rf "$out/derived"
"$root/pipelines/bids/brainshift-bids" "$out/bids" "$out/derived" participant --quiet --one-job --brainshift "$program" \
  --set discretise.nodes=200 --set segment.edge_length=12
validate "$out/bids"
validate "$out/derived"
# A validator that saw no file would pass all: a wrong name must be found.
touch "$out/derived/sub-00001/anat/sub-00001_space-intraop_desc-wrong_T2.nii.gz"
if validate "$out/derived" > "$out/wrong.txt"; then
  echo "validate.sh: the validator does not see a file with a wrong name in $out/derived" >&2
  exit 1
fi
echo "The validator found no error in either dataset, and a wrong name where there was one."
