# A terminal driven by keys, for the shell tests that need one; read with `.' after tap.sh.  Without tmux the
# test is skipped.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

if ! command -v tmux >/dev/null 2>&1; then
  skip 'there is no tmux here'
  finish
fi

TMUX_TMPDIR=$scratch
export TMUX_TMPDIR
unset TMUX
trap 'itself && { pane kill-server 2>/dev/null; rm -rf "$scratch"; }' EXIT

# Each terminal is a server of its own: one that is on its way out takes no more.
server=0
pane ()
{
  tmux -L "bight$server" "$@"
}

# begin COLUMNS ROWS SETTING...: a shell in a terminal of that size, with variables set.
begin ()
{
  columns=$1
  rows=$2
  shift 2
  setting=$*
  for try in 1 2 3; do # a server now and then dies at birth
    pane kill-server 2>/dev/null
    server=$((server + 1))
    pane -f /dev/null new-session -d -x "$columns" -y "$rows" \
      "exec env PS1='shell> ' $setting '$top_builddir/pre-inst-env' sh" && see 'shell>$' && return 0
    diag "no terminal at try $try"
  done
  return 1
}

screen ()
{
  pane capture-pane -p
}

shows ()
{
  screen | grep -q -- "$1"
}

# see PATTERN: wait until the screen shows it.
see ()
{
  await shows "$1" && return 0
  diag "not seen: $1"
  diag "$(screen | cut -c1-79 | tail -5)"
  return 1
}

keys ()
{
  pane send-keys "$@"
}

# pressed PATTERN KEY...: press KEY, and look for a while whether the screen shows PATTERN.
pressed ()
{
  pressed_pattern=$1
  shift
  keys "$@"
  for look in 1 2 3 4 5 6 7 8 9 10; do
    shows "$pressed_pattern" && return 0
    moment 1
  done
  return 1
}

# prod PATTERN KEY...: press KEY until the screen shows PATTERN, which it does only for a while: on a loaded
# machine that while may be over before anybody looks.
prod ()
{
  await pressed "$@" && return 0
  diag "not seen after $2: $1"
  diag "$(screen | cut -c1-79 | tail -5)"
  return 1
}

given_back ()
{
  [ "$(pane display-message -p '#{alternate_on} #{cursor_flag}')" = '0 1' ]
}

# The terminal is as a shell wants it: what is typed is seen, and a line is a line.  A shell whose child is
# killed prompts at once, perhaps still on the other page; so it is asked for another prompt.
sane ()
{
  await given_back || return 1
  keys Enter
  see 'shell>$' || return 1
  keys "stty -a | grep -c ' echo ' | sed 's/^/echoes /'" Enter
  see 'echoes 1$' || return 1
  keys "stty -a | grep -c ' icanon ' | sed 's/^/lines /'" Enter
  see 'lines 1$' && given_back
}
