# What stands in the way of a newcomer is told in one clear line with its cure: a machine without the packages,
# a full disk, no terminal, no home.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
BIGHT_LOGBOOK=$scratch/logbook.db
XDG_STATE_HOME=$scratch/state
export BIGHT_LOGBOOK XDG_STATE_HOME

# said NAME STATUS PATTERN COMMAND...: it ends with STATUS and one line on standard error, with PATTERN in it.
said ()
{
  said_name=$1 said_status=$2 said_pattern=$3
  shift 3
  "$@" >"$scratch/out" 2>"$scratch/err" </dev/null
  said_found=$?
  if [ $said_found -eq "$said_status" ] && [ "$(wc -l <"$scratch/err")" -eq 1 ] \
    && grep -q "^bight: .*$said_pattern" "$scratch/err"; then
    result 0 "$said_name"
  else
    result 1 "$said_name"
    diag "status $said_found" "$(head -c 2000 "$scratch/err")"
  fi
}

# ---- bootstrap ----

mkdir "$scratch/bin" "$scratch/tools"
for tool in sh dirname tail grep tr sed head mkdir cat env; do
  ln -s "$(command -v $tool)" "$scratch/tools/$tool"
done
printf '#!/bin/sh\nexit 1\n' >"$scratch/bin/dpkg-query"
printf '#!/bin/sh\necho "Reading lists"\necho "E: Unable to fetch some archives" >&2\nexit 100\n' >"$scratch/bin/apt-get"
printf '#!/bin/sh\necho "$PRETEND_ID"\n' >"$scratch/bin/id"
chmod +x "$scratch"/bin/*

bare ()
{
  bare_id=$1 bare_build=$2
  shift 2
  env PATH="$scratch/bin:$scratch/tools" PRETEND_ID="$bare_id" BIGHT_BUILD="$bare_build" \
    "$scratch/tools/sh" "$top_srcdir/bootstrap" "$@"
}

said 'without root and sudo, what to install is told' 1 'please run as root: apt-get install .*guile-3.0' \
  bare 1000 "$scratch/build"
said 'without a network, why, and how to go on' 1 'guile-3.0.*Unable to fetch.*--no-packages' bare 0 "$scratch/build"
said 'a compiler with a blank is an option of configure' 1 'Unable to fetch' bare 0 "$scratch/build" CC='ccache gcc'
said 'a folder that cannot be written has another name' 1 'BIGHT_BUILD=' bare 0 /dev/null/build

# ---- The program ----

if [ -w /dev/full ]; then
  full ()
  {
    "$pre" bight "$@" >/dev/full
  }
  said 'a full disk' 1 'cannot write to the standard output: No space' full -c 1
  said 'a full disk, much to write' 1 'cannot write: No space' full -c '(display (make-string 100000 #\a))'
  said 'a full disk, and an exit' 1 'cannot write to the standard output: No space' full -c '(display 1) (exit 3)'
  said 'a full disk, of a lesson' 1 'cannot write\(.*\)\{0,1\}: No space' full lesson read-the-bow --check
else
  skip 'a full disk: no /dev/full here'
fi

said 'a dive is flown in a terminal' 1 'standard input and output are none; with ssh, ssh -t' "$pre" bight pilot pile

homeless ()
{
  env -u BIGHT_LOGBOOK -u XDG_STATE_HOME HOME=/dev/null/none "$pre" bight "$@"
}
said 'a lesson without a home cannot be left' 0 'go on later.*XDG_STATE_HOME' homeless lesson read-the-bow --typed
homeless lessons >"$scratch/out" 2>"$scratch/err"
grep -q '^01  read-the-bow' "$scratch/out"
result $? 'without a home there are lessons'
empty 'and no complaint' "$scratch/err"

[ "$(env -i PATH="$PATH" "$pre" bight -c '(display "bört")' 2>&1)" = bört ]
result $? 'any letter is printed in any locale'

# A locale of people who write a decimal comma is made of its description.
if mkdir "$scratch/locales" && localedef -i de_DE -f UTF-8 "$scratch/locales/de_DE.UTF-8" 2>"$scratch/err"; then
  tell="(enter! 'cross-current) (run 0.5) (look) (write (max-tension)) (status)
    (enter! (world (sea (depth 50)) (rov (named m) (at 0 0 -5.5)) (tether (from 0 0 -1) (to m) (length 2.25))))"
  "$pre" bight -c "$tell" >"$scratch/out" 2>&1
  env LOCPATH="$scratch/locales" LC_ALL=de_DE.UTF-8 "$pre" bight -c "$tell" >"$scratch/comma" 2>&1
  [ "$(env LOCPATH="$scratch/locales" LC_ALL=de_DE.UTF-8 locale decimal_point)" = , ] &&
    grep -q '2\.25 m long' "$scratch/out" && cmp "$scratch/out" "$scratch/comma"
  result $? 'a decimal point is a point where people write a comma'
else
  skip 'there are no locales (Debian package: locales)'
fi

finish
