# bight follow from outside: a simulated ArduSub by log and by UDP, with everything that may be wrong; tables from a
# file, a pipe and a socket; frames that others' encoders wrote; and that nothing is ever sent.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

if ! command -v python3 >/dev/null 2>&1; then
  skip 'there is no python3, in which the vehicle is simulated'
  finish
fi
pre=$top_builddir/pre-inst-env
sub=$top_srcdir/tests/follow/ardusub.py
follower=
feeder=
trap 'itself && { kill $follower $feeder 2>/dev/null; rm -rf "$scratch"; }' EXIT
PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE

# told FILE PATTERN NAME
told ()
{
  grep -q -- "$2" "$1"
  told_status=$?
  result $told_status "$3"
  [ $told_status -eq 0 ] || diag "not told: $2; but: $(cat "$1")"
}

# world_of NAME ORIGIN: a world for the vehicle with a line that costs little; the line of the world that is taken
# when none is named moves, and is followed by frames of others and tables below.
world_of ()
{
  cat >"$scratch/$1.scm" <<SCM
(define-world $1
  "Where the simulated vehicle dives."
  (sea    (depth 40) $2)
  (rov    (named minnow) (type bluerov2-heavy) (at 0 6 -5))
  (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -2) (to minnow) (length 25) (model catenary)))
SCM
}
world_of pool ''
world_of bay '(origin 54 4)'

# log_of FAULT...: what following the log of a vehicle with these faults says, in $scratch/out.
log_of ()
{
  python3 "$sub" tlog "$scratch/log.tlog" "$@"
  "$pre" bight follow "$scratch/log.tlog" --in "$scratch/pool.scm" --every 100 >"$scratch/out" 2>"$scratch/err" </dev/null
  [ ! -s "$scratch/err" ] || diag "$(cat "$scratch/err")"
}

# ---- A log ----

log_of
told "$scratch/out" '^ *29.0 s  at (15.0 6.0 -11.0) heading 90, 21.0 m out$' 'a log is followed to its end'
told "$scratch/out" '^measured: payout 21.00 m, tension 50.00 N, turns 1.50, battery 15.80 V$' 'with all that was measured'
told "$scratch/out" '^0.00 m from where it says it is, 0.00 m at most$' 'and the dive is where the vehicle was'
grep '^state' "$scratch/out" >"$scratch/state"

log_of v1
grep '^state' "$scratch/out" | cmp -s - "$scratch/state"
result $? 'version 1 of MAVLink gives the same bits'
log_of flood noise
grep '^state' "$scratch/out" | cmp -s - "$scratch/state"
result $? 'so does a flood, with noise between frames'
told "$scratch/out" ' bytes that belong to no frame' 'which is counted'
log_of foreign
grep '^state' "$scratch/out" | cmp -s - "$scratch/state"
result $? 'another vehicle has no say'
told "$scratch/out" '^301 frames of other systems' 'and is counted'

# survives PATTERN...: the dive of the log ends where it should, and what was wrong is told.
survives ()
{
  told "$scratch/out" ' at (15.0 6.0 -11.0) heading 90' "a dive with $faults ends where it should"
  for pattern; do
    told "$scratch/out" "$pattern" "and tells: $pattern"
  done
}
faults='checksums outlier absurd late dropout'
log_of $faults
survives 'frames with a bad checksum' '3 positions too far off' '1 readings beyond all bounds' '1 positions that came late'
faults=clock
log_of $faults
survives '1 jumps of the clock'
faults=reboot
log_of $faults
survives '1 jumps of the clock'
log_of cut
told "$scratch/out" ' 1[0-9].[0-9]* s  at .*m out' 'a log that was cut off is followed as far as it goes'
told "$scratch/out" '^1 frames cut off at the end' 'and that is told'
log_of reset
told "$scratch/out" '1 moves of the whole track' 'a track that moves as a whole is believed'
told "$scratch/out" '^COACH: You are at the end of your tether' 'and the coach speaks'

log_of degrees
told "$scratch/err" 'the world has no origin' 'degrees want a world with an origin'
"$pre" bight follow "$scratch/log.tlog" --in "$scratch/bay.scm" --every 100 >"$scratch/out" 2>&1
told "$scratch/out" ' 29.0 s  at (15.0 6.0 -11.0) heading 90' 'in one that has it the vehicle is where it was'

# ---- Frames that others wrote ----

for version in 1 2; do
  "$pre" bight follow "$top_srcdir/tests/data/telemetry/others-$version.tlog" >"$scratch/others-$version" 2>&1
  told "$scratch/others-$version" ' 3.0 s  at (2.0 7.0 -4.0) heading 29, 14.0 m out' "node-mavlink, version $version"
done
if command -v node >/dev/null 2>&1 && node -e 'require("node-mavlink")' 2>/dev/null; then
  for version in 1 2; do
    node "$top_srcdir/tests/follow/others.cjs" "$scratch/new.tlog" $version
    cmp -s "$scratch/new.tlog" "$top_srcdir/tests/data/telemetry/others-$version.tlog"
    result $? "the frames that are kept are node-mavlink's own, version $version"
  done
else
  skip 'there is no node-mavlink to write those frames anew'
fi

# ---- UDP ----

# A port of this machine that is free now.
free_port ()
{
  python3 -c 'import socket
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}
listens ()
{
  grep -qi "^ *[0-9]*: 0100007F:$(printf '%04X' "$port") " /proc/net/udp
}

# hear COMMAND...: follow what comes by UDP with the command before `bight'.
hear ()
{
  port=$(free_port)
  "$@" "$pre" bight follow "udp:$port" --in "$scratch/pool.scm" --keep "$scratch/kept.tlog" \
    --record "$scratch/dive" --for 20 --every 100 >"$scratch/out" 2>"$scratch/err" </dev/null &
  follower=$!
  await listens
}

if [ -r /proc/net/udp ]; then
  hear env
  result $? 'it listens on this machine'
  python3 "$sub" udp "$port" >"$scratch/sent"
  await gone $follower
  result $? 'and ends after so many seconds of the dive'
  told "$scratch/sent" ' back 0$' 'nothing comes back to the vehicle'
  told "$scratch/out" ' 20.1 s  at (10.55 6.0 -9.22) heading 90' 'the dive is where the vehicle was'
  "$pre" bight follow "$scratch/kept.tlog" --in "$scratch/pool.scm" --for 20 --every 100 >"$scratch/again" 2>&1
  [ "$(grep '^state' "$scratch/again")" = "$(grep '^state' "$scratch/out")" ]
  result $? 'what was kept gives the same bits'
  "$pre" bight replay "$scratch/dive" >"$scratch/replayed" 2>&1
  told "$scratch/replayed" 'identical' 'and so does the recording'
  port=$(free_port)
  "$pre" bight follow "udp:$port" --in "$scratch/pool.scm" --every 100 >"$scratch/out" 2>"$scratch/err" </dev/null &
  follower=$!
  await listens
  python3 "$sub" udp "$port" leave >"$scratch/sent" &
  feeder=$!
  await grep -q ' s  at ' "$scratch/out"
  await gone $feeder
  kill -INT $follower
  await gone $follower
  told "$scratch/out" '^state ' '^C ends it with all that is to be told'
  empty 'and no error' "$scratch/err"
  if command -v strace >/dev/null 2>&1 && strace -o "$scratch/nothing" true 2>/dev/null; then
    hear strace -f -o "$scratch/calls" -e trace=network,write
    python3 "$sub" udp "$port" >"$scratch/sent"
    await gone $follower
    grep -c 'recvfrom(' "$scratch/calls" >"$scratch/received"
    [ "$(cat "$scratch/received")" -gt 100 ]
    result $? 'the kernel saw it receive'
    grep -E '(sendto|sendmsg|sendmmsg|connect)\(' "$scratch/calls" | grep -v AF_UNIX >"$scratch/sends"
    empty 'and never send' "$scratch/sends"
  else
    skip 'no strace looks at what is sent'
  fi
  if [ "$(id -u)" -eq 0 ] && command -v setpriv >/dev/null 2>&1 && [ -x /usr/bin/python3 ]; then
    # What belongs to root is everybody's; what belongs to nobody is not root's.
    hear env
    cp "$sub" "$scratch/sub.py"
    chmod 755 "$scratch" && chmod 644 "$scratch/sub.py"
    setpriv --reuid=65534 --regid=65534 --clear-groups env PATH=/usr/bin:/bin \
      python3 "$scratch/sub.py" udp "$port" leave >"$scratch/sent"
    told "$scratch/sent" '^sent 939 ' "another user's program sends" 
    python3 "$sub" udp "$port" >"$scratch/sent"
    await gone $follower
    told "$scratch/out" '939 datagrams of other users. programs' "what another user's program sends is not listened to"
    told "$scratch/out" ' 20.1 s  at (10.55 6.0 -9.22) heading 90' "and one's own is"
  else
    skip "only root, with a python3 that everybody may run, can be another user's program"
  fi
else
  skip 'no /proc/net/udp tells who listens'
fi
"$pre" bight follow udp:192.0.2.7:14550 >"$scratch/out" 2>&1
told "$scratch/out" 'bight listens on this machine alone' 'it listens nowhere else'

# ---- Tables ----

awk 'BEGIN { print "time_ms,rov_x,rov_y,depth_ft,heading,payout,tension_kN"
  for (i = 0; i <= 100; i++)
    printf "%d,%.3f,6,%.5f,%d,%.2f,0.01\n", 100 * i, i * 0.05, (5 + i * 0.02) / 0.3048, 45, 12 + i * 0.03 }' \
  >"$scratch/dive.csv"
end=' 9.0 s  at (5.0 6.0 -7.0) heading 45, 1[45].[0-9]* m out'
"$pre" bight follow "$scratch/dive.csv" --every 100 >"$scratch/out" 2>&1
told "$scratch/out" "$end" 'a table is followed'
told "$scratch/out" 'tension 10.00 N' 'with its units'
grep '^state' "$scratch/out" >"$scratch/state"
# same NAME: what was followed has the same bits.
same ()
{
  await gone $follower
  grep '^state' "$scratch/out" | cmp -s - "$scratch/state"
  result $? "$1"
}
"$pre" bight follow - --every 100 <"$scratch/dive.csv" >"$scratch/out" 2>&1
same 'the standard input gives the same bits'
mkfifo "$scratch/pipe"
"$pre" bight follow "$scratch/pipe" --every 100 >"$scratch/out" 2>&1 </dev/null &
follower=$!
while read -r line; do echo "$line"; done <"$scratch/dive.csv" >"$scratch/pipe"
same 'so does a pipe, line by line'
python3 - "$scratch/socket" "$scratch/dive.csv" >"$scratch/heard" 2>&1 <<'PY' &
import socket, sys
s = socket.socket(socket.AF_UNIX)
s.bind(sys.argv[1])
s.listen(1)
c, _ = s.accept()
c.sendall(open(sys.argv[2], "rb").read())
c.shutdown(socket.SHUT_WR)
print("heard", c.recv(100))
PY
feeder=$!
await test -S "$scratch/socket"
"$pre" bight follow "$scratch/socket" --every 100 >"$scratch/out" 2>&1 </dev/null
follower=$!
same 'and a socket'
await gone $feeder
told "$scratch/heard" "^heard b''$" 'to which nothing is said'
if [ "$(id -u)" -eq 0 ]; then
  chown 65534 "$scratch/socket"
  "$pre" bight follow "$scratch/socket" >"$scratch/out" 2>&1 </dev/null
  told "$scratch/out" 'belongs to somebody else' "another user's socket is not asked"
else
  skip "only root can make another user's socket"
fi

# ---- What is wrong with what is asked ----

# refused PATTERN ARGUMENT...: one clear line, and exit 1.
refused ()
{
  pattern=$1
  shift
  "$pre" bight follow "$@" >"$scratch/out" 2>"$scratch/err" </dev/null
  [ $? -eq 1 ] && [ "$(wc -l <"$scratch/err")" -eq 1 ] && grep -q -- "$pattern" "$scratch/err"
  refused_status=$?
  result $refused_status "refused: $pattern"
  [ $refused_status -eq 0 ] || diag "$(cat "$scratch/err")"
}
refused 'name one source'
refused 'no such file\|No such file' "$scratch/nothing.csv"
refused 'cannot write' "$scratch/dive.csv" --keep /nowhere/at/all
refused '--for is seconds' "$scratch/dive.csv" --for x
refused 'the list of worlds has no' "$scratch/dive.csv" --in nowhere-known
printf 'a,b\n1,2\n' >"$scratch/odd.csv"
refused 'names the columns' "$scratch/odd.csv"
: >"$scratch/empty.tlog"
refused 'nothing in it says where the vehicle is' "$scratch/empty.tlog"
head -c 20000 /dev/urandom >"$scratch/random.tlog"
refused 'nothing in it says where the vehicle is' "$scratch/random.tlog"
finish
