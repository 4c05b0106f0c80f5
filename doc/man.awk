# The manual page: bight.1.in with @COMMANDS@ made of what `bight --help' says and @VERSION@ filled in.
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

# A line of the usage: how to call it, then two spaces or more, then what it does; or more of that.
NR == FNR && done { next }
NR == FNR && /^$/ { done = 1; next }
NR == FNR {
  sub(/^Usage: /, "       ")
  if (/^       bight/) {
    sub(/^ +/, "")
    at = match($0, /  +/)
    call = at ? substr($0, 1, at - 1) : $0
    text = at ? substr($0, at + RLENGTH) : ""
    commands = commands ".TP\n.B " escape(call) "\n" (text == "" ? "" : escape(text) "\n")
  } else {
    sub(/^ +/, "")
    commands = commands escape($0) "\n"
  }
  next
}

$0 == "@COMMANDS@" { printf "%s", commands; next }
{ gsub(/@VERSION@/, version); print }
