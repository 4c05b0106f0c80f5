"""Fly and ask a dive of bight from Python:  door = Door("dive.sock"); door.ask("(rov-position)")"""
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
import re, socket

TOKEN = re.compile(r'\s*(?:([()])|"((?:[^"\\]|\\.)*)"|([^\s()"]+))')
ESCAPE = re.compile(r"\\(?:x(..)|u(....)|U(......)|(.))")
SHORT = dict(zip("abfnrtv0", "\a\b\f\n\r\t\v\0"))
WORDS = {"#t": True, "#f": False, "+inf.0": float("inf"), "-inf.0": -float("inf"), "+nan.0": float("nan")}


def atom(word):
    for read in (WORDS.__getitem__, int, float, lambda w: int(w.split("/")[0]) / int(w.split("/")[1])):
        try:
            return read(word)
        except (KeyError, ValueError, IndexError):
            pass
    return word  # a symbol


def datum(line):
    stack = [[]]
    for bracket, text, word in TOKEN.findall(line):
        if bracket == "(":
            stack.append([])
        elif bracket == ")":
            stack[-2].append(stack.pop())
        else:
            unescape = lambda m: SHORT.get(m[4], m[4]) or chr(int(m[m.lastindex], 16))
            stack[-1].append(atom(word) if word else ESCAPE.sub(unescape, text))
    return stack[0][0]


class Door:
    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        self.lines = self.socket.makefile("r", encoding="utf-8")
        self.waiting = []  # events that came before an answer

    def ask(self, form):
        """What FORM returns; what it printed is printed here; what went wrong is raised."""
        self.socket.sendall((form.replace("\n", " ") + "\n").encode())
        for head, *rest in map(datum, self.lines):
            if head == "ok":
                return rest[0] if rest else None
            if head == "error":
                raise RuntimeError("%s: %s" % tuple(rest))
            print(rest[0], end="") if head == "printed" else self.waiting.append([head] + rest)
        raise EOFError("bight has gone")

    def event(self):
        """The next event of a subscription: ["event", number, value] or ["ended", number, kind, text]."""
        return self.waiting.pop(0) if self.waiting else datum(next(self.lines))
