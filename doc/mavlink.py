"""Make the live dive behind a door of bight a vehicle of a ground station, such as QGroundControl or MAVProxy:

    python3 mavlink.py dive.sock [STATION-PORT [VEHICLE]]

It sends HEARTBEAT, ATTITUDE and LOCAL_POSITION_NED to that port of this machine, 14550 when left out, as ArduSub's
simulator does, and flies what MANUAL_CONTROL comes back.  Without any for a second all sticks are let go."""
# Frames are MAVLink 2, unsigned (mavlink.io/en/guide/serialization.html; message set `common').
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
import math, select, socket, struct, sys, time
from door import Door

EXTRA = {0: 50, 30: 39, 32: 185, 69: 243}  # what the definition of a message adds to its checksum
SUBMARINE, ARDUPILOT, MANUAL, ACTIVE = 12, 3, 19, 4
ARMED = 0x81


def checksum(data):
    crc = 0xFFFF
    for byte in data:
        byte ^= crc & 0xFF
        byte ^= byte << 4 & 0xFF
        crc = crc >> 8 ^ byte << 8 ^ byte << 3 ^ byte >> 4
    return struct.pack("<H", crc)


class Link:
    def __init__(self, port):
        self.station = ("127.0.0.1", port)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.sequence = 0

    def send(self, number, payload):
        payload = payload.rstrip(b"\0") or b"\0"
        body = struct.pack("<BBBBBBHB", len(payload), 0, 0, self.sequence, 1, 1, number, 0) + payload
        self.socket.sendto(b"\xfd" + body + checksum(body + bytes([EXTRA[number]])), self.station)
        self.sequence = (self.sequence + 1) % 256

    def manual_controls(self, seconds):
        """The x, y, z, r, each of a thousand, of every MANUAL_CONTROL that comes from the station within SECONDS."""
        while select.select([self.socket], [], [], seconds)[0]:
            frame, sender = self.socket.recvfrom(4096)
            seconds = 0
            if sender != self.station or len(frame) < 12 or frame[0] != 0xFD or len(frame) < 12 + frame[1]:
                continue
            body, end = frame[1:10 + frame[1]], frame[10 + frame[1]:12 + frame[1]]
            if frame[7:10] == b"\x45\0\0" and checksum(body + bytes([EXTRA[69]])) == end:
                yield struct.unpack("<hhhh", frame[10:10 + frame[1]].ljust(8, b"\0")[:8])


def drive(door, x, y, z, r, vehicle):
    """Sticks of a thousand; ArduSub's z is 0 down to 1000 up, and 500 rests."""
    way = lambda value: max(-1, min(1, value / 1000))
    door.ask("(drive! %s #:surge %s #:sway %s #:heave %s #:yaw %s)"
             % (vehicle, way(x), way(y), way(2 * (z - 500)), way(r)))


def tell(door, link, vehicle):
    now, (x, y, z), (u, v, w), heading = door.ask(
        "(list (now) (rov-position{0}) (rov-velocity{0}) (rov-heading{0}))".format(vehicle))
    ms = round(now * 1000) & 0xFFFFFFFF
    link.send(30, struct.pack("<Iffffff", ms, 0, 0, math.remainder(math.radians(heading), math.tau), 0, 0, 0))
    link.send(32, struct.pack("<Iffffff", ms, y, x, -z, v, u, -w))


def main(path, port="14550", vehicle=""):
    door, link = Door(path), Link(int(port))
    vehicle = vehicle and " '" + vehicle
    heard, beat = None, 0
    while True:
        for controls in link.manual_controls(0.05):
            heard = time.monotonic()
            drive(door, *controls, vehicle)
        if heard and time.monotonic() - heard > 1:
            heard = drive(door, 0, 0, 500, 0, vehicle)
        if time.monotonic() - beat >= 1:
            beat = time.monotonic()
            link.send(0, struct.pack("<IBBBBB", MANUAL, SUBMARINE, ARDUPILOT, ARMED, ACTIVE, 3))
        tell(door, link, vehicle)


if __name__ == "__main__":
    main(*sys.argv[1:])
