#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What Snakemake asks about a job of Slurm: running, success or failed. A job that Slurm has forgotten has failed: had
# it ended well, Snakemake would have been told while Slurm still knew it.
state=$(scontrol --oneliner show job "$1" 2>/dev/null | grep -o 'JobState=[A-Z_]*')
case ${state#JobState=} in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | STAGE_OUT) echo running ;;
  *) echo failed ;;
esac
