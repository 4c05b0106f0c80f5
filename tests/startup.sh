# What a start costs: the libraries it loads, and its time beside plain guile's.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env

"$pre" bight -c 1 </dev/null >"$scratch/out" 2>"$scratch/err"
result $? 'bight -c 1 succeeds'
[ "$(cat "$scratch/out")" = 1 ]
result $? 'and prints 1'
empty 'and nothing on standard error' "$scratch/err"

# The loader tells of every library of the process, however it came in.
"$pre" env LD_DEBUG=files LD_DEBUG_OUTPUT="$scratch/ld" bight -c 1 </dev/null >/dev/null 2>&1
cat "$scratch"/ld.* 2>/dev/null | sed -n 's/.*calling init: //p' | sort -u >"$scratch/loaded"
grep -q libguile "$scratch/loaded"
result $? 'the loader names what it loads'
grep -E '/lib(GL|EGL|GLX|OSMesa|OpenGL|GLdispatch|assimp|gdal|proj|sqlite3|cairo|chafa|readline|SDL2)[-.0-9]' "$scratch/loaded" >"$scratch/heavy"
empty 'no GL, mesh, picture, database, line editing or controller library among them' "$scratch/heavy"

# Told, not judged: the best of seven starts of each.
best ()
{
  "$pre" sh -c '
    best=
    for i in 1 2 3 4 5 6 7; do
      a=$(date +%s%N)
      "$@" </dev/null >/dev/null 2>&1
      b=$(date +%s%N)
      t=$(((b - a) / 1000))
      if [ -z "$best" ] || [ "$t" -lt "$best" ]; then best=$t; fi
    done
    echo "$best"' sh "$@"
}
ours=$(best bight -c 1)
theirs=$(best "$GUILE" -c 1)
diag "bight -c 1: $ours us; guile -c 1: $theirs us; wanted at most $((2 * theirs + 20000)) us"
finish
