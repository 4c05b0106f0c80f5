# Other programs' controls fly a live dive through its door: a gamepad's events, and MAVLink from a ground station,
# which in turn sees the dive as a vehicle; bight follow is the judge of what the station is sent.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/socket.sh"

if ! command -v python3 >/dev/null 2>&1; then
  skip 'there is no python3, in which the examples are written'
  finish
fi
PYTHONDONTWRITEBYTECODE=1
PYTHONPATH=$top_srcdir/doc:$top_srcdir/tests/follow
export PYTHONDONTWRITEBYTECODE PYTHONPATH
begin_house --door

# sticks_are PATTERN: the last that the house told of them.
sticks_are ()
{
  tail -n 1 "$scratch/told" | grep -q -- " #f64($1))\$"
}

# ---- A gamepad ----

mkfifo "$scratch/pad" "$scratch/wait"
python3 "$top_srcdir/doc/gamepad.py" "$socket" "$scratch/pad" >"$scratch/out" 2>&1 &
talker=$!
# Half ahead; a button; a stick near its middle; a quarter down; in pieces, as a device does not give them.
python3 -c 'import struct, sys
e = lambda value, kind, number: struct.pack("<IhBB", 1, value, kind, number)
data = e(-16384, 0x82, 1) + e(1, 1, 3) + e(900, 2, 0) + e(8192, 2, 4)
for piece in (data[:13], data[13:]):
    sys.stdout.buffer.write(piece); sys.stdout.flush()
open(sys.argv[1]).read()' "$scratch/wait" >"$scratch/pad" &
feeder=$!
await sticks_are '0.5 0.0 -0.25 0.0'
result $? 'a gamepad flies it'
: >"$scratch/wait"
await gone $talker $feeder
sticks_now ()
{
  [ "$(wc -l <"$scratch/told")" -gt "$lines" ] && sticks_are '0.0 0.0 0.0 0.0'
}
lines=$(wc -l <"$scratch/told")
await sticks_now
result $? 'one that is gone has let go'
empty 'without a complaint' "$scratch/out"

# ---- A ground station ----

cat >"$scratch/station.py" <<'PY'
import select, socket, struct, subprocess, sys
import ardusub

ardusub.EXTRA[69] = 243
station = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
station.bind(("127.0.0.1", 0))
bridge = subprocess.Popen([sys.executable, sys.argv[1], sys.argv[2], str(station.getsockname()[1])])
pilot, log, place = ardusub.Vehicle(2, system=255), b"", None


def frame():
    global log, place
    data, sender = station.recvfrom(4096)
    number = data[7]
    if number in (30, 32):
        ms, = struct.unpack("<I", data[10:10 + data[1]].ljust(4, b"\0")[:4])
        log += struct.pack(">Q", 1700000000000000 + 1000 * ms) + data
    if number == 32:
        place = struct.unpack("<Iffffff", data[10:10 + data[1]].ljust(28, b"\0"))
    return number, sender


def controls(x, y, z, r):
    return pilot.frame(69, struct.pack("<hhhhHB", x, y, z, r, 0, 1))


seen = {frame()[0] for _ in range(20)}
assert {0, 30, 32} <= seen, seen
wrong = bytearray(controls(1000, 0, 0, 0))
wrong[-1] ^= 1
stranger = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
north = place[1]
for i in range(90):
    number, sender = frame()
    for data in (wrong, b"\xfd", b"\xfd\xff" + bytes(12), b"", pilot.heartbeat()):
        station.sendto(data, sender)
    stranger.sendto(controls(0, 1000, 500, 0), sender)
    if i >= 30:
        station.sendto(controls(400, 0, 500, 0), sender)
print("flown", flush=True)
while not select.select([sys.stdin], [], [], 0)[0]:  # until the test has seen enough
    frame()
bridge.kill()
open(sys.argv[3], "wb").write(log)
print("at %.1f %.1f %.1f, moved %s" % (place[2], place[1], -place[3], abs(place[1] - north) > 0.05))
PY
mkfifo "$scratch/go"
python3 "$scratch/station.py" "$top_srcdir/doc/mavlink.py" "$socket" "$scratch/seen.tlog" \
  <"$scratch/go" >"$scratch/out" 2>&1 &
talker=$!
exec 9>"$scratch/go"
await sticks_are '0.4 0.0 0.0 0.0'
result $? 'a ground station flies it'
await grep -q flown "$scratch/out"
! grep -q '#f64(1.0 \|#f64([^ ]* 1.0 ' "$scratch/told"
result $? 'and what is no order of its own did nothing'
lines=$(wc -l <"$scratch/told")
await sticks_now
result $? 'when the station falls silent the sticks are let go'
exec 9>&-
await gone $talker
talker=
place=$(sed -n 's/^at \(.*\), moved True$/\1/p' "$scratch/out")
[ -n "$place" ]
result $? 'it sees where the vehicle is'
[ -n "$place" ] || diag "$(cat "$scratch/out")"
"$pre" bight follow "$scratch/seen.tlog" --every 1000 >"$scratch/followed" 2>&1
grep -q '0.00 m from where it says it is' "$scratch/followed"
followed=$?
result $followed 'bight follow understands what the station was sent'
[ $followed -eq 0 ] || diag "$(cat "$scratch/followed")"
finish
