# What the shell tests share; read with `.'.  Each test ends with `finish'.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

set -u
LC_ALL=C.UTF-8
export LC_ALL
tests=0
failures=0
scratch=$(mktemp -d) || exit 99
trap 'rm -rf "$scratch"' EXIT

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
