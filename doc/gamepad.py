"""Fly the live dive behind a door of bight with a gamepad:  python3 gamepad.py dive.sock [/dev/input/js0]"""
# Events are those of Linux's joystick interface: time, value, kind, number (linux/joystick.h).
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
import os, struct, sys
from door import Door

AXES = {0: ("sway", 1), 1: ("surge", -1), 3: ("yaw", 1), 4: ("heave", -1)}  # the two sticks of most pads
DEAD = 0.08  # of the way: a stick that is let go rests near the middle


def sticks(events):
    """What EVENTS, bytes, say of the sticks: a name and -1 to 1 for each that moved."""
    moved = {}
    for time, value, kind, number in struct.iter_unpack("<IhBB", events):
        if kind & 2 and number in AXES:
            name, sign = AXES[number]
            way = max(-1, min(1, sign * value / 32767))
            moved[name] = 0 if abs(way) < DEAD else round(way, 3)
    return moved


def main(path, device="/dev/input/js0"):
    door, pad, rest = Door(path), os.open(device, os.O_RDONLY), b""
    try:
        while got := os.read(pad, 4096):  # all that came meanwhile is one order
            rest, whole = (rest + got)[len(rest + got) // 8 * 8:], (rest + got)[:len(rest + got) // 8 * 8]
            if moved := sticks(whole):
                door.ask("(drive! %s)" % " ".join("#:%s %s" % stick for stick in moved.items()))
    finally:
        door.ask("(drive! #:surge 0 #:sway 0 #:heave 0 #:yaw 0)")


if __name__ == "__main__":
    main(*sys.argv[1:])
