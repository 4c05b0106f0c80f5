# Random calls of the language: each succeeds or raises a &bight-error, and what is refused changes nothing.
# BIGHT_LONG=1 makes 100000 calls; `bight tests/fuzz/fuzz.scm --sequences N --seed S' more, or others.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

sequences=1250
[ "${BIGHT_LONG:-}" != 1 ] || sequences=5000
# Seconds of processor time for a call: it is there to find calls without an end, and the dearest that has one
# (a picture from within a crowd of solids) takes 2.5 on one machine and twice that on another.
limit=10
if [ "${sanitize:-no}" = yes ]; then
  limit=20
else
  ulimit -v 8000000 # a runaway takes itself down, not the machine
fi

"$top_builddir/pre-inst-env" bight "$top_srcdir/tests/fuzz/fuzz.scm" \
  --sequences $sequences --limit $limit </dev/null >"$scratch/out" 2>&1
result $? "$((sequences * 20)) random calls are answered or refused"
diag "$(tail -n 200 "$scratch/out")"
grep 'runtime error:' "$scratch/out" >"$scratch/undefined"
empty 'without undefined behaviour, where a sanitizer looks for it' "$scratch/undefined"

# A watchman who never barks may be asleep: with a wrong answer among the names, there is a finding.
"$top_builddir/pre-inst-env" bight "$top_srcdir/tests/fuzz/fuzz.scm" --sequences 80 --limit 0.5 --bait \
  </dev/null >"$scratch/out" 2>&1
result $(($? != 1)) 'with wrong answers put in by hand it exits 1'
for what in 'raised "wrong-type-arg' 'the dive changed' 'ran longer than' 'cannot be printed' \
  'ended with signal'; do
  grep -q "^finding .*$what" "$scratch/out"
  result $? "and a finding says: $what"
done
finish
