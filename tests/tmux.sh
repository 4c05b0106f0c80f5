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
trap 'pane kill-server 2>/dev/null; rm -rf "$scratch"' EXIT

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

# see PATTERN [SECONDS]: wait until the screen shows it.
see ()
{
  left=$((5 * ${2:-15}))
  until screen | grep -q -- "$1"; do
    left=$((left - 1))
    if [ "$left" -le 0 ]; then
      diag "not seen: $1"
      diag "$(screen | cut -c1-79 | tail -5)"
      return 1
    fi
    sleep 0.2
  done
}

keys ()
{
  pane send-keys "$@"
}

# The terminal is as a shell wants it: what is typed is seen, and a line is a line.
sane ()
{
  see 'shell>$' 10 || return 1
  keys "stty -a | grep -c ' echo ' | sed 's/^/echoes /'" Enter
  see '^echoes 1' 10 || return 1
  keys "stty -a | grep -c ' icanon ' | sed 's/^/lines /'" Enter
  see '^lines 1' 10 && [ "$(pane display-message -p '#{alternate_on} #{cursor_flag}')" = '0 1' ]
}
