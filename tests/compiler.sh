# Does Guile's compiler, with the flags of this build, keep to what the text says?  Some releases read in a loop
# what may not be there, and the program ends by SIGSEGV; configure looks for that and chooses the flags.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
GUILE_AUTO_COMPILE=0
export GUILE_AUTO_COMPILE
ulimit -c 0

loops=$top_srcdir/scheme/guarded-loops.scm
check 'guarded loops mean what they say, interpreted' "$GUILE" -s "$loops"
for level in -O1 -O2 -O3; do
  "$GUILD" compile $level $BT_GUILDFLAGS -o "$scratch/loops.go" "$loops" >"$scratch/said" 2>&1 &&
    "$GUILE" -c "(load-compiled \"$scratch/loops.go\")" >>"$scratch/said" 2>&1
  result $? "and compiled with $level $BT_GUILDFLAGS"
  diag "$(cat "$scratch/said")"
done
finish
