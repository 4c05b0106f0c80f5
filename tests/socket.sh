# A house with a dive that goes on by itself, behind a socket, for the shell tests that talk to it; read with `.'
# after tap.sh.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

pre=$top_builddir/pre-inst-env
XDG_RUNTIME_DIR=$scratch/run
export XDG_RUNTIME_DIR
mkdir -m 700 "$XDG_RUNTIME_DIR"
house=
talker=
trap 'itself && { kill $house $talker 2>/dev/null; rm -rf "$scratch"; }' EXIT

# Whoever talks to the house for longer is `talker'.

# The house lets a dive go live, and tells again and again how far it is.
cat >"$scratch/house.scm" <<'SCM'
(enter! 'pile)
(live!)
(let loop ()
  (write (list (now) (sticks)))
  (newline)
  (force-output)
  (usleep 100000)
  (loop))
SCM
socket=$scratch/socket

# begin_house OPTION: the house with a socket of that kind, at $socket.
begin_house ()
{
  "$pre" bight "$1=$socket" "$scratch/house.scm" >"$scratch/told" 2>"$scratch/err" &
  house=$!
  await test -S "$socket"
  result $? 'a socket is there'
  [ "$(stat -c %a "$socket")" = 600 ]
  result $? 'for its owner alone'
  await has_lines 1 "$scratch/told"
}
