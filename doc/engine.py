"""The engine of bight from Python, through its C library:  python3 engine.py

A world is made by the engine's own table of fields, so that no part is described here: {"length": 30} sets the field
`length', checked by the engine."""
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
import ctypes as c

lib = c.CDLL("libbight.so.0")


class Head(c.Structure):  # bt_head, as far as it is looked at
    _fields_ = [("name", c.c_char_p), ("inside", c.c_char_p), ("text", c.c_char_p), ("size", c.c_size_t)]


class Error(c.Structure):  # bt_error
    _fields_ = [("status", c.c_int), ("text", c.c_char * 400)]


class Point(c.Structure):  # bt_vec3
    _fields_ = [("x", c.c_double), ("y", c.c_double), ("z", c.c_double)]


class Parts(c.Structure):  # an array and its length, as bt_world has them after the sea
    _fields_ = [("first", c.c_void_p), ("n", c.c_int)]


lib.bt_head_find.restype = c.POINTER(Head)
lib.bt_field_find.restype = c.c_void_p
lib.bt_dive_time.restype = c.c_double


def call(name, *arguments):
    """Call a function that returns a bt_status and takes a bt_error last."""
    error = Error()
    if getattr(lib, name)(*arguments, c.byref(error)):
        raise ValueError(error.text.decode())


def part(head, fields, name=None, type=None):
    """The struct of a part; FIELDS are numbers, points (x, y, z), words, and names of parts."""
    kind = lib.bt_head_find(head.encode())
    struct = c.create_string_buffer(kind.contents.size)
    lib.bt_def_init(kind, struct)
    if name:  # the first member of every part but the sea
        call("bt_def_set_name", struct, name.encode())
    if type:
        call("bt_def_set_%s_type" % ("tether" if head == "tether" else "vehicle"), struct, type.encode())
    for field, value in fields.items():
        place = lib.bt_field_find(kind, field.encode())
        if not place:
            raise ValueError(f"a {head} has no field {field}")
        if isinstance(value, tuple):
            call("bt_def_set_point", c.c_void_p(place), struct, Point(*value))
        elif isinstance(value, str):
            setter = "bt_def_set_part" if field in ("from", "to") else "bt_def_set_word"
            call(setter, c.c_void_p(place), struct, value.encode())
        else:
            call("bt_def_set_number", c.c_void_p(place), struct, c.c_double(value))
    return struct.raw


class Dive:
    def __init__(self, sea, rovs, tethers):
        arrays = [c.create_string_buffer(b"".join(parts)) for parts in (rovs, tethers, [])]
        rows = [bytes(Parts(c.addressof(a), len(p))) for a, p in zip(arrays, (rovs, tethers, []))]
        world, model, self.dive = c.create_string_buffer(sea + b"".join(rows)), c.c_void_p(), c.c_void_p()
        call("bt_model_new", world, c.byref(model))
        call("bt_dive_new", model, None, None, c.byref(self.dive))
        lib.bt_model_release(model)  # the dive keeps it

    def __del__(self):
        lib.bt_dive_free(self.dive)

    def run(self, seconds):
        end = lib.bt_dive_time(self.dive) + seconds
        while lib.bt_dive_time(self.dive) < end - 1e-9:
            call("bt_dive_step", self.dive)
        return lib.bt_dive_time(self.dive)

    def points(self, n, tether=0):
        """N points equally spaced along a tether."""
        points = (Point * n)()
        call("bt_tether_points", self.dive, tether, n, points)
        return [(p.x, p.y, p.z) for p in points]

    def tensions(self, n, tether=0):
        tensions = (c.c_double * n)()
        call("bt_tether_tensions", self.dive, tether, n, tensions)
        return list(tensions)


if __name__ == "__main__":
    dive = Dive(part("sea", {"depth": 50}),
                [part("rov", {"at": (12.0, 0.0, -5.0)}, name="minnow")],
                [part("tether", {"from": (0.0, 0.0, -5.0), "to": "minnow", "length": 20, "wet-weight": 0.5,
                                 "model": "elastic"}, name="line", type="fathom")])
    dive.run(1)
    print("lowest point %.2f m, tension at the vehicle %.2f N"
          % (min(z for x, y, z in dive.points(41)), dive.tensions(2)[1]))
