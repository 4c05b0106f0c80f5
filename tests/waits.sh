# No test waits by the clock: for a time after which something should have happened, or for no longer than an
# idle machine takes.  What has to come is waited for with `await' (tests/tap.sh).
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
cd "$top_srcdir/tests" || exit 99

# by_clock FILE...: the lines that wait by it; a remark may speak of it.
by_clock ()
{
  grep -nHE '(^|[^-_([:alnum:]])(sleep|timeout)[[:space:]]+[0-9."$]' "$@" |
    grep -vE '^[^:]*:[0-9]*:[[:space:]]*#|timeout "\$patience"'
}

by_clock $(ls ./*.sh | grep -vx -e ./tap.sh -e ./waits.sh) >"$scratch/shell"
empty 'no shell test waits by the clock' "$scratch/shell"
grep -nE '\((sleep|get-internal-real-time|gettimeofday|current-time)( |\))' scheme/*.scm scenario/*.scm |
  grep -v '"(' >"$scratch/scheme"
empty 'no test in Scheme does' "$scratch/scheme"
grep -nE '\<(u|nano)?sleep \(|bt_live_wait \([^+;]*, [0-9.]+\);|\<alarm \([1-9][0-9]?\)' unit/*.c law/*.c >"$scratch/c"
empty 'no test in C does' "$scratch/c"

# A watchman who never barks may be asleep.
printf 'start &\nsleep 2\ntimeout 5 end\n' >"$scratch/bad.sh"
by_clock "$scratch/bad.sh" >"$scratch/found"
[ "$(wc -l <"$scratch/found")" -eq 2 ]
result $? 'one that did would be found'
late ()
{
  moment 3
  echo 1 >"$scratch/late"
}
late &
await has_lines 1 "$scratch/late"
result $? 'what comes late is waited for'
(patience=0 && ! await false)
result $? 'and what never comes is given up'
finish
