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

# ---- MAVLink: the simulated vehicle of tests/follow ----

if command -v python3 >/dev/null 2>&1; then
  PYTHONDONTWRITEBYTECODE=1
  export PYTHONDONTWRITEBYTECODE
  sub=$top_srcdir/tests/follow/ardusub.py
  cat >"$scratch/pool.scm" <<'SCM'
(define-world pool
  "Where the simulated vehicle dives."
  (sea    (depth 40) (current 0.2 90))
  (rov    (named minnow) (type kinematic) (at 0 6 -5))
  (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 6) (from 0 0 -2) (to minnow) (length 25)))
SCM

  # believed SOURCE OPTION...: what following it with a belief says, in $scratch/out; its lines of the belief in $scratch/told.
  believed ()
  {
    source=$1
    shift
    "$pre" bight follow "$source" --in "$scratch/pool.scm" --every 100 --for 15 --belief "$scratch/doubts.scm" --tethers 8 \
      --tension-noise 5 "$@" >"$scratch/out" 2>"$scratch/err" </dev/null
    grep '^belief' "$scratch/out" >"$scratch/told"
  }

  # log_of FAULT...: the same of the log of a vehicle with these faults.
  log_of ()
  {
    python3 "$sub" tlog "$scratch/log.tlog" "$@"
    believed "$scratch/log.tlog"
  }
  log_of
  empty 'a log of MAVLink drives a belief' "$scratch/err"
  says "$scratch/told" '^belief: 8 tethers, P(wound) 0.0, [1-9][0-9]* tensions taken, [1-9][0-9]* that no tether explains$' \
    'whose tensions are evidence, or told to be none'
  cp "$scratch/told" "$scratch/first"
  log_of v1 flood noise foreign
  cmp -s "$scratch/first" "$scratch/told"
  result $? 'version 1, a flood, noise and another vehicle give the same belief, to the last bit'
  log_of checksums outlier absurd late dropout
  says "$scratch/told" '^belief: 8 tethers, ' 'one that is spoilt is followed, too'
  awk 'BEGIN { print "t,x,y,z,heading,payout,tension"
    for (i = 0; i <= 300; i++) {
      t = i / 10; turned = t < 10 ? 9 * t : 90
      printf "%.1f,%.2f,6,%.2f,%.1f,%s\n", t, t / 2, -5 - t / 5, turned, i % 5 ? "," : (12 + 0.3 * t) "," (20 + t) } }' \
    >"$scratch/same.csv"
  believed "$scratch/same.csv"
  # A row has its payout behind its place, so that the dive by the table begins with another one, half a second newer.
  taken_in () { sed -n 's/.*, \([0-9]*\) tensions taken, \([0-9]*\) that.*/\1 \2/p' "$1"; }
  set -- $(taken_in "$scratch/first") $(taken_in "$scratch/told")
  [ $# -eq 4 ] && [ $(($1 - $3)) -le 1 ] && [ $(($3 - $1)) -le 1 ] && [ "$2" -eq "$4" ]
  result $? 'and a table of the same dive teaches the same, but for one tension at the beginning'

  if [ -r /proc/net/udp ]; then
    port=$(python3 -c 'import socket
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
    listens ()
    {
      grep -qi "^ *[0-9]*: 0100007F:$(printf '%04X' "$port") " /proc/net/udp
    }
    believed "udp:$port" --keep "$scratch/kept.tlog" &
    follower=$!
    await listens
    python3 "$sub" udp "$port" >"$scratch/sent"
    await gone $follower
    cp "$scratch/told" "$scratch/by-udp"
    says "$scratch/by-udp" '^belief [0-9a-f]*$' 'a stream by UDP drives a belief'
    believed "$scratch/kept.tlog"
    cmp -s "$scratch/by-udp" "$scratch/told"
    result $? 'what was kept of it gives the same belief, to the last bit'
  fi
else
  skip 'there is no python3, in which a vehicle of MAVLink is simulated'
fi

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
