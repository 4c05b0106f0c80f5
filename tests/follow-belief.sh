# bight follow --belief: tensions that come drive a belief, alarms come by probability, and the same log gives the same
# bits.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env

cat >"$scratch/pole.scm" <<'SCM'
(define-world pole
  "A post beside which a vehicle dives."
  (sea      (depth 20) (current 0.2 90))
  (cylinder (named post) (from 3 6 1) (to 3 6 -20) (radius 0.3))
  (rov      (named minnow) (type kinematic) (at 0 12 -8) (heading 0))
  (tether   (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 8) (from 0 0 -2) (to minnow) (length 20)))
SCM

# East behind the post, then south, at 1 m/s, and back the same way; a tension now and then, one of them absurd.
awk 'BEGIN { print "t,x,y,z,payout,tension"
  for (i = 0; i <= 108; i++) {
    k = i <= 54 ? i : 108 - i
    x = k < 32 ? k / 4 : 8; y = k < 32 ? 12 : 12 - (k - 32) / 3
    printf "%.2f,%.3f,%.3f,-8,20,%s\n", i / 4, x, y, i == 60 ? "9000" : i % 4 ? "" : "1.5" } }' >"$scratch/dive.csv"

# follow_it OPTION...: what following it says, in $scratch/out.
follow_it ()
{
  "$pre" bight follow "$scratch/dive.csv" --in "$scratch/pole.scm" --every 100 "$@" >"$scratch/out" 2>"$scratch/err" \
    </dev/null
}

# says FILE PATTERN NAME
says ()
{
  grep -q -- "$2" "$1"
  says_status=$?
  result $says_status "$3"
  [ $says_status -eq 0 ] || diag "not told: $2; but: $(cat "$1")"
}

follow_it
grep '^state' "$scratch/out" >"$scratch/state"
says "$scratch/out" '^state [0-9a-f]*$' 'a log is followed without a belief'

cat >"$scratch/doubts.scm" <<'SCM'
; What is uncertain.
(current (error 0.1) (levels 0 -20))
(line (cdn (uniform 1 1.6)))
SCM
follow_it --belief "$scratch/doubts.scm" --tethers 8
empty 'with a belief nothing goes wrong' "$scratch/err"
says "$scratch/out" '^BELIEF: P(wound) [01].[0-9]* and rising; go back.  Home: ' 'an alarm comes by probability, with a way back'
says "$scratch/out" '^BELIEF: P(wound) [01].[0-9]* and falling' 'and is taken back when the vehicle has gone back'
says "$scratch/out" '^belief: 8 tethers, P(wound) 0.0, 25 tensions taken, 1 that no tether explains$' \
  'tensions are taken, and what no tether explains is counted'
grep '^state' "$scratch/out" | cmp -s - "$scratch/state"
result $? 'the dive is what it is without a belief, to the last bit'
cp "$scratch/out" "$scratch/once"

follow_it --belief '(current (error 0.1) (levels 0 -20)) (line (cdn (uniform 1 1.6)))' --tethers 8
cmp -s "$scratch/once" "$scratch/out"
result $? 'the same log followed again, with the clauses in words, says the same, its belief to the last bit'
says "$scratch/out" '^belief [0-9a-f]*$' 'of which the hash is told'

# refused PATTERN TEXT: a belief of TEXT is refused with PATTERN, before anything is followed.
refused ()
{
  follow_it --belief "$2" --tethers 8
  says "$scratch/err" "$1" "refused: $2"
  empty 'and nothing is followed' "$scratch/out"
}
refused "has no part.*lien\|lien" '(lien (cdn (uniform 1 1.6)))'
refused 'needs uniform, normal or one-of\|distribution' '(line (cdn (gauss 1 1.6)))'
refused 'is told by clauses' '((('
refused 'cannot read' "$scratch/nothing.scm"
follow_it --belief '(current (error 0.1))' --tethers 3
says "$scratch/err" 'whole number from 8 to 4096' 'and so are too few tethers'
finish
