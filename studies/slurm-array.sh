#!/bin/sh
#SBATCH --job-name=bight-sweep
#SBATCH --array=1-16
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#
# Fly a study as a Slurm array, a shard for each task.  The parts are as many as the array has tasks; a
# task that ran out of time goes on where it was when it is submitted again.
#
#   sbatch slurm-array.sh STUDY.scm
#   bight sweep --merge STUDY.db STUDY.*-of-16.db
#
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

set -eu
exec bight sweep "$1" -j "${SLURM_CPUS_PER_TASK:-1}" \
  --shard "$SLURM_ARRAY_TASK_ID/${SLURM_ARRAY_TASK_COUNT:-1}"
