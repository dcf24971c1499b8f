#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What Snakemake asks about a job of Slurm: running, success or failed. A job that Slurm has forgotten has failed: had
# it ended well, Snakemake would have been told while Slurm still knew it. Where Slurm does not answer, or the state is
# of a job that may go on, it runs.
said=$(scontrol --oneliner show job "$1" 2>&1)
state=$(grep -o 'JobState=[A-Z_]*' <<< "$said")
case ${state#JobState=} in
  COMPLETED) echo success ;;
  BOOT_FAIL | CANCELLED | DEADLINE | FAILED | NODE_FAIL | OUT_OF_MEMORY | PREEMPTED | REVOKED | TIMEOUT) echo failed ;;
  '') grep -q 'Invalid job id' <<< "$said" && echo failed || echo running ;;
  *) echo running ;;
esac
