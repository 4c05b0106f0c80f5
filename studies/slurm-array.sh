#!/bin/sh
#SBATCH --job-name=bight-sweep
#SBATCH --array=1-16
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#
# Fly a study as a Slurm array: task I flies the I-th of N parts, 16 when N is left out.  N belongs to the study
# and not to the submission, so any tasks can be submitted again by themselves; each goes on where it was.
# `bight sweep STUDY.scm --slurm' does all of this by itself.
#
#   sbatch slurm-array.sh STUDY.scm
#   sbatch --array=3,7 slurm-array.sh STUDY.scm        two tasks again
#   sbatch --array=1-40 slurm-array.sh STUDY.scm 40    forty parts
#   bight sweep --merge STUDY.db STUDY.*-of-16.db
#
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

set -eu
if [ $# -lt 1 ] || [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
  echo 'usage: sbatch [--array=TASKS] slurm-array.sh STUDY.scm [N]' >&2
  exit 1
fi
exec bight sweep "$1" -j "${SLURM_CPUS_PER_TASK:-1}" --shard "$SLURM_ARRAY_TASK_ID/${2:-16}"
