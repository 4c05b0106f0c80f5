# What the shell tests share; read with `.'.  Each test ends with `finish'.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

set -u
LC_ALL=C.UTF-8
export LC_ALL
tests=0
failures=0
scratch=$(mktemp -d) || exit 99

# In this process itself: bash runs the EXIT trap of its parent in a child that a signal meets before the child has
# become its command, and the parent would go on without its files.
itself ()
{
  sh -c "[ \$PPID -eq $$ ]"
}
trap 'itself && rm -rf "$scratch"' EXIT

diag ()
{
  printf '%s\n' "$*" | sed 's/^/# /'
}

# result STATUS NAME: STATUS 0 is a pass.
result ()
{
  tests=$((tests + 1))
  if [ "$1" -eq 0 ]; then
    echo "ok $tests - $2"
  else
    failures=$((failures + 1))
    echo "not ok $tests - $2"
  fi
}

# check NAME COMMAND...: passes when COMMAND does; what it says is shown when it does not.
check ()
{
  check_name=$1
  shift
  "$@" >"$scratch/check.out" 2>&1
  check_status=$?
  result $check_status "$check_name"
  [ $check_status -eq 0 ] || diag "$(cat "$scratch/check.out")"
}

# empty NAME FILE: passes when FILE is empty.
empty ()
{
  if [ -s "$2" ]; then
    result 1 "$1"
    diag "$(cat "$2")"
  else
    result 0 "$1"
  fi
}

# How long a test waits for what has to come, s.  However slow the machine is, what comes is waited for:
# only what never comes takes so long.
patience=${BIGHT_PATIENCE:-300}

# await COMMAND...: wait until COMMAND succeeds.  No other line of a test waits (tests/waits.sh): neither for
# a time after which something should have happened, nor for less than a loaded machine may take.
await ()
{
  await_end=$(($(date +%s) + patience))
  until "$@"; do
    [ "$(date +%s)" -lt "$await_end" ] || return 1
    sleep 0.1
  done
}

# has_lines N FILE: FILE has N lines or more.
has_lines ()
{
  [ "$(cat "$2" 2>/dev/null | wc -l)" -ge "$1" ]
}

# gone PROCESS...: none of them is there any more, or only its status is.
gone ()
{
  for gone_process; do
    case $(ps -o stat= -p "$gone_process" 2>/dev/null) in
      '' | Z*) ;;
      *) return 1 ;;
    esac
  done
}

# moment TENTHS: let so many tenths of a second pass, for what may happen at any time.  What a test expects
# afterwards must be true however long it was.
moment ()
{
  sleep "$(($1 / 10)).$(($1 % 10))"
}

skip ()
{
  tests=$((tests + 1))
  echo "ok $tests # SKIP $1"
}

# The driver counts failures from the results: an exit status would be counted as one more.
# `finish strictly' is for a test that runs without the driver.
finish ()
{
  echo "1..$tests"
  [ $failures -eq 0 ] || [ "${1:-}" != strictly ]
  exit
}
