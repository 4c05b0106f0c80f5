#!/usr/bin/env python3
"""A simulated ArduSub: MAVLink frames of a vehicle's dive, written from the public message definitions.

    ardusub.py tlog FILE [FAULT...]     write a log of 30 s
    ardusub.py udp PORT [FAULT...]      send it to that port of this machine, and tell what came back

It shares no code with what reads it: the checksum is a table's, the payloads are struct's.  The vehicle swims
east at 0.5 m/s from a place 6 m north of the origin, turning from north to east, 0.2 m/s down, while its winch
pays out 0.3 m/s.  A FAULT spoils the stream: v1, checksums, dropout, clock, reboot, outlier, reset, flood, cut,
noise, degrees, foreign, late, absurd, blind.  It stays until nobody listens any more, unless told to leave.

Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
"""
import math
import random
import socket
import struct
import sys
import time

EXTRA = {0: 50, 30: 39, 32: 185, 33: 104, 74: 20, 137: 195, 147: 154, 251: 170}
LENGTH_V1 = {0: 9, 30: 28, 32: 28, 33: 28, 74: 20, 137: 14, 147: 36, 251: 18}
TABLE = []
for i in range(256):
    r = i
    for _ in range(8):
        r = (r >> 1) ^ 0x8408 if r & 1 else r >> 1
    TABLE.append(r)


def crc(data):
    r = 0xFFFF
    for b in data:
        r = (r >> 8) ^ TABLE[(r ^ b) & 0xFF]
    return r


class Vehicle:
    def __init__(self, version, system=1):
        self.version, self.system, self.sequence = version, system, 250

    def frame(self, number, payload):
        sequence, self.sequence = self.sequence, (self.sequence + 1) % 256
        if self.version == 1:
            body = struct.pack("<BBBBB", LENGTH_V1[number], sequence, self.system, 1, number)
            body += payload[:LENGTH_V1[number]]
            start = b"\xfe"
        else:
            short = payload.rstrip(b"\0") or b"\0"
            body = struct.pack("<BBBBBB", len(short), 0, 0, sequence, self.system, 1)
            body += struct.pack("<I", number)[:3] + short
            start = b"\xfd"
        return start + body + struct.pack("<H", crc(body + bytes([EXTRA[number]])))

    def heartbeat(self):
        return self.frame(0, struct.pack("<IBBBBB", 19, 12, 3, 81, 4, 3))

    def attitude(self, ms, yaw):
        return self.frame(30, struct.pack("<Iffffff", ms, 0.02, -0.01, yaw, 0, 0, 0))

    def local(self, ms, north, east, down):
        return self.frame(32, struct.pack("<Iffffff", ms, north, east, down, 0, 0.5, 0.2))

    def globally(self, ms, lat, lon, height):
        return self.frame(33, struct.pack("<IiiiihhhH", ms, round(lat * 1e7), round(lon * 1e7),
                                          round(height * 1e3), round(height * 1e3), 0, 50, 20, 9000))

    def hud(self, speed, heading, alt):
        return self.frame(74, struct.pack("<ffffhH", speed, speed, alt, -0.2, heading, 50))

    def pressure(self, ms, depth):
        hpa = (101325 + 1025 * 9.80665 * depth) / 100
        return self.frame(137, struct.pack("<Iffhh", ms, hpa, 0, 1150, 0))

    def battery(self):
        cells = [15800] + [65535] * 9
        return self.frame(147, struct.pack("<iih10HhBBBb", 100, -1, 2000, *cells, 1240, 0, 0, 0, 80))

    def named(self, ms, name, value):
        return self.frame(251, struct.pack("<If10s", ms, value, name.encode()))


def where(t):
    """North, east, down, heading (rad), line out after t seconds."""
    return 6.0, 0.5 * t, 5.0 + 0.2 * t, math.pi / 2 * min(1, t / 10), 12 + 0.3 * t


def degrees(north, east):
    """About 54 N 4 E; a degree is so long there (WGS 84)."""
    phi = math.radians(54)
    a, e2 = 6378137.0, 0.00669437999014
    w = 1 - e2 * math.sin(phi) ** 2
    return (54 + math.degrees(north / (a * (1 - e2) / w ** 1.5)),
            4 + math.degrees(east / (a / math.sqrt(w) * math.cos(phi))))


def stream(faults):
    """Pairs of a time, s, and the bytes that are sent then."""
    random.seed(7)
    vehicle = Vehicle(1 if "v1" in faults else 2)
    other = Vehicle(2, system=7)
    for i in range(301):
        t = i / 10
        north, east, down, yaw, out = where(t)
        ms = 100000 + 100 * i
        if "dropout" in faults and 8 < t < 15:
            continue
        if "clock" in faults and t >= 20:
            ms += 3600000
        if "reboot" in faults and t >= 20:
            ms -= 115000
        if "outlier" in faults and i in (70, 71, 190):
            east += 300
        if "absurd" in faults and i in (50, 55):
            north = float("inf") if i == 50 else 1e30
        if "reset" in faults and t >= 18:
            north += 20
        if "late" in faults and i == 170:
            ms -= 400
        frames = [vehicle.attitude(ms, yaw)]
        if "degrees" in faults:
            frames.append(vehicle.globally(ms, *degrees(north, east), -down))
        elif "blind" not in faults:
            frames.append(vehicle.local(ms, north, east, down))
        if i % 5 == 0:
            frames += [vehicle.pressure(ms, down), vehicle.named(ms, "payout", out),
                       vehicle.named(ms, "tension_N", 20 + t), vehicle.hud(0.5, round(math.degrees(yaw)), -down)]
        if i % 10 == 0:
            frames += [vehicle.heartbeat(), vehicle.battery(), vehicle.named(ms, "TetherTrn", 1.5)]
        if "foreign" in faults:
            frames.append(other.local(ms, -500, 0, 0))
        if "flood" in faults:
            frames += [vehicle.attitude(ms, yaw)] * 60
        if "checksums" in faults and i % 20 == 7:
            frames[1] = frames[1][:-1] + bytes([frames[1][-1] ^ 0x55])
        if "noise" in faults and i % 10 == 3:
            frames.insert(1, bytes(random.randrange(256) for _ in range(40)))
        yield t, frames


def write_log(name, faults):
    data = b"".join(struct.pack(">Q", 1700000000000000 + round(t * 1e6)) + frame
                    for t, frames in stream(faults) for frame in frames)
    if "cut" in faults:
        data = data[:len(data) * 2 // 3 + 5]
    with open(name, "wb") as out:
        out.write(data)


def waiting(port):
    """Bytes that wait at PORT of this machine to be read, or None: nobody listens there."""
    with open("/proc/net/udp") as table:
        for line in table:
            words = line.split()
            if words[1].upper() == "0100007F:%04X" % port:
                return int(words[4].split(":")[1], 16)


def send(port, faults):
    vehicle = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    vehicle.bind(("127.0.0.1", 0))
    vehicle.setblocking(False)
    sent = 0
    for _, frames in stream(faults):
        for frame in frames:
            while sent % 16 == 0 and (waiting(port) or 0) > 50000:  # no more than the reader has room for
                time.sleep(0.01)
            vehicle.sendto(frame, ("127.0.0.1", port))
            sent += 1
    while "leave" not in faults and waiting(port) is not None:
        time.sleep(0.05)
    back = 0
    try:
        while vehicle.recvfrom(65536):
            back += 1
    except BlockingIOError:
        pass
    print("sent", sent, "back", back)


if __name__ == "__main__":
    (write_log if sys.argv[1] == "tlog" else send)(
        sys.argv[2] if sys.argv[1] == "tlog" else int(sys.argv[2]), sys.argv[3:])
