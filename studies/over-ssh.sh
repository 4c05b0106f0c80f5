#!/bin/sh
# Fly a study on several machines: STUDY.scm, then the machines, each with bight and this folder at the same
# place; a machine may be named more than once.  Copies the shards here and puts them together.
#
#   sh over-ssh.sh STUDY.scm node1 node2 node3
#
# With GNU parallel (and rsync, which brings the files) it is one line, and a machine that is done takes the
# next shard; each shard is flown by the cores of one machine, and written to its own file.  The files stay on
# the machines, which go on with them; `--cleanup' would delete the results where the machines share a folder.
#
#   parallel -S node1,node2,node3 -j 1 --workdir . --return STUDY.{}-of-12.db \
#     bight sweep STUDY.scm -o STUDY.{}-of-12.db --shard {}/12 ::: $(seq 12)
#   bight sweep --merge STUDY.db STUDY.*-of-12.db
#
# BIGHT_SSH is what runs a command on a machine, BIGHT_SCP what fetches a file, if not ssh and scp; `-j' in
# BIGHT_SWEEP is how many dives each machine flies at a time.
#
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

set -eu
if [ $# -lt 2 ]; then
  echo 'usage: over-ssh.sh STUDY.scm MACHINE...' >&2
  exit 1
fi
study=$1
name=$(basename "$study" .scm)
shift
parts=$#
here=$(pwd)
ssh=${BIGHT_SSH:-ssh}
scp=${BIGHT_SCP:-scp -q}

# Each machine flies its part; one that fails leaves what it has, and the next call goes on with it.
i=0
fliers=
for machine in "$@"; do
  i=$((i + 1))
  $ssh "$machine" "cd '$here' && bight sweep '$study' ${BIGHT_SWEEP:-} --shard $i/$parts" &
  fliers="$fliers $!"
done
failed=0
for flier in $fliers; do
  wait "$flier" || failed=1
done

# A machine that sees the file made here has written its shard here already.
mark=.$name.$$.here
trap 'rm -f "$mark"' EXIT
: >"$mark"
i=0
for machine in "$@"; do
  i=$((i + 1))
  shard=$name.$i-of-$parts.db
  $ssh "$machine" "test -e '$here/$mark'" || $scp "$machine:$here/$shard" "$shard" || failed=1
done
bight sweep --merge "$name.db" "$name".*-of-"$parts".db || failed=1
exit $failed
