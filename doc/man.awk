# The manual page: bight.1.in with @COMMANDS@ made of what `bight --help all' says and @VERSION@ filled in.
#
#   awk -v version=V -f man.awk HELP bight.1.in
#
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

function escape(text)
{
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  sub(/^[.']/, "\\\\\\&&", text)
  return text
}

function add(line)
{
  commands = commands line "\n"
}

# How to call it; then lines of what it does, two blanks in; then its options, two blanks in too, and
# lines about them farther in.
NR == FNR && /^Usage: / {
  example = 0
  sub(/^Usage: /, "")
  add(".TP\n.B " escape($0))
  next
}
NR == FNR && /^  -/ {
  sub(/^ +/, "")
  at = match($0, /   *[^ ]/)
  add(".RS\n.TP\n.B " escape(at ? substr($0, 1, at - 1) : $0))
  if (at)
    add(escape(substr($0, at + RLENGTH - 1)))
  add(".RE")
  next
}
NR == FNR && /^For example:/ {
  add(".br\n" escape($0))
  example = 1
  next
}
NR == FNR && example && /^  / {
  sub(/^ +/, "")
  add(".br\n.B " escape($0))
  next
}
NR == FNR {
  if (/^      /)
    # More about an option: before the end of its block.
    sub(/\.RE\n$/, "", commands)
  more = /^      /
  sub(/^ +/, "")
  add(escape($0))
  if (more)
    add(".RE")
  next
}

$0 == "@COMMANDS@" { printf "%s", commands; next }
{ gsub(/@VERSION@/, version); print }
