#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What brainshift-bids promises, shown on phantoms: participants broken on purpose stop nobody else; the bytes of single
# runs; jobs killed at random, a full disk, the engine and the queue killed: the same command finishes and repeats
# nothing that was whole; how busy the cores are and what a participant costs above its run. On this machine, and on a
# Slurm of one node that is started here and ended. Writes DIR/show.md. Ends with 1 where a promise is broken.
#
#   bash tests/bids/show.sh [--out DIR] [--participants N] [--broken N] [--faulted N] [--slurm N] [--no-install]
#
# N participants run undisturbed, --faulted of them once more under each fault, --slurm of them on Slurm (0: none). The
# full disk is a small tmpfs and Slurm wants to be root; both are left out for others.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

out=$root/build/bids_show install=yes words=()
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$2; shift ;;
    --participants | --broken | --faulted | --slurm) words+=("$1" "$2"); shift ;;
    --no-install) install=no ;;
    *) sed -n '/^#   bash/s/^#   /usage: /p' "$0" >&2; exit 2 ;;
  esac
  shift
done
[ $install = no ] || install_packages python3 snakemake slurm-wlm >&2
program=${BRAINSHIFT:-$(built_program)}
/usr/bin/python3 "$root/tests/bids/show.py" "$program" "$out" "${words[@]}"
