# Run by `make installcheck': the library, the program and the modules as installed, each found only
# through what `make install' put in place.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

unset GUILE_LOAD_PATH GUILE_LOAD_COMPILED_PATH GUILE_EXTENSIONS_PATH BIGHT_UNINSTALLED BIGHT_WORLDS
GUILE_AUTO_COMPILE=0
ASAN_OPTIONS=detect_leaks=0
export GUILE_AUTO_COMPILE ASAN_OPTIONS

# there FOLDER SOURCE-FOLDER PATTERN: everything like PATTERN in the second is in the first, as installed.
there ()
{
  (cd "$2" && find . -name "$3") | while read -r file; do
    [ -f "$destdir$1/$file" ] || echo "$file"
  done >"$scratch/missing"
  empty "every $3 of $(basename "$2") is in $1" "$scratch/missing"
}

there "$includedir/bight" "$top_srcdir/src/bight" '*.h'
there "$moddir/bight" "$top_srcdir/scheme/bight" '*.scm'
there "$pkgdatadir/worlds" "$top_srcdir/worlds" '*.scm'
there "$pkgdatadir/lessons" "$top_srcdir/lessons" '*.scm'
[ -f "$destdir$man1dir/bight.1" ] || [ -f "$destdir$man1dir/bight.1.gz" ] # as packages have it
result $? 'the manual page is there'
if [ -f "$top_builddir/doc/bight.info" ]; then
  [ -f "$destdir$infodir/bight.info" ]
  result $? 'so is the manual'
else
  skip 'there is no manual'
fi

# Nothing below DESTDIR stands where it was configured to stand: what is there must not speak of it.
if [ -n "$destdir" ]; then
  grep -rlF -e "$destdir" "$destdir" >"$scratch/told" 2>/dev/null
  empty 'nothing that was installed speaks of DESTDIR' "$scratch/told"
  finish strictly
fi

PKG_CONFIG_PATH=$pkgconfigdir${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
LD_LIBRARY_PATH=$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export PKG_CONFIG_PATH LD_LIBRARY_PATH

check 'pkg-config knows bight' $PKG_CONFIG --exists --print-errors bight
flags="$($PKG_CONFIG --cflags --libs bight) $BT_LDFLAGS -lm"
check 'a C11 program builds' \
  $CC -std=c11 "$top_srcdir/tests/consumer/consumer.c" -o "$scratch/c" $flags
check 'and runs' "$scratch/c"
if [ -n "$CXX" ]; then
  check 'a C++17 program builds' \
    $CXX -std=c++17 "$top_srcdir/tests/consumer/consumer.cc" -o "$scratch/cc" $flags
  check 'and runs' "$scratch/cc"
else
  skip 'no C++ compiler (Debian package: g++)'
fi

for header in "$includedir"/bight/*.h; do
  printf "#include <bight/%s>\ntypedef int not_empty;\n" "$(basename "$header")"
done >"$scratch/all.c"
check 'every header is complete' $CC -std=c11 $($PKG_CONFIG --cflags bight) -fsyntax-only "$scratch/all.c"

"$bindir/bight" -c 1 </dev/null >"$scratch/out" 2>"$scratch/err"
result $? 'bight -c 1 succeeds'
[ "$(cat "$scratch/out")" = 1 ]
result $? 'and prints 1'
empty 'and nothing on standard error' "$scratch/err"

# From any folder; everything is found through the program's own place.
run ()
{
  (cd "$scratch" && HOME=$scratch "$bindir/bight" "$@") </dev/null >"$scratch/out" 2>"$scratch/err"
}
run -c '(for-each (lambda (w) (enter! w)) (worlds)) (length (worlds))'
result $? 'every world can be entered'
[ "$(cat "$scratch/out")" = "$(find "$top_srcdir/worlds" -name '*.scm' | wc -l)" ]
result $? 'and all are found'
empty 'and nothing is said on standard error' "$scratch/err"
run test "$top_srcdir/tests/scenario/thesis.scm" "$top_srcdir/tests/scenario/pilot.scm"
result $? 'it passes scenario tests'

if [ -x "$pkglibexecdir/bight-mesh-reader" ]; then
  cp "$top_srcdir/tests/data/mesh/cube.obj" "$scratch"
  run -c '(enter! (world (sea (depth 50)) (mesh (named m) (file "cube.obj") (at 0 0 -20)) (rov (at 0 9 -9))
    (tether (from 0 0 0) (length 20)))) (parts)'
  result $? 'mesh files are read'
  grep -qw m "$scratch/out"
  result $? 'and become parts'
else
  skip 'there is no reader of mesh files'
  skip 'there is no reader of mesh files'
fi
if [ -x "$pkglibexecdir/bight-geo-reader" ]; then
  printf '10.3 63.5 -30\n10.4 63.5 -30\n10.5 63.5 -30\n10.3 63.4 -30\n10.4 63.4 -30\n10.5 63.4 -30\n' >"$scratch/bed.xyz"
  run -c '(enter! (world (sea (depth 50)) (seabed (grid "bed.xyz") (origin 63.45 10.4)) (rov (at 0 9 -9))
    (tether (from 0 0 0) (length 20)))) (rov-altitude)'
  result $? 'geographic files are read'
else
  skip 'there is no reader of geographic files'
fi
if [ -f "$extensiondir/bight-render.so" ]; then
  run snapshot open-water -o bow.png --size 64x48
  result $? 'pictures are drawn'
  [ -s "$scratch/bow.png" ]
  result $? 'and written'
else
  skip 'there is no renderer'
  skip 'there is no renderer'
fi

# A module older than its source would be compiled again by every user.
(cd "$moddir" && find bight.scm bight -name '*.scm') | while read -r module; do
  compiled=$ccachedir/${module%.scm}.go
  [ -f "$compiled" ] || echo "$module is not compiled"
  [ ! "$moddir/$module" -nt "$compiled" ] || echo "$module is younger than $compiled"
done >"$scratch/stale"
empty 'every module is compiled, and younger than its source' "$scratch/stale"

GUILE_AUTO_COMPILE=1 HOME=$scratch XDG_CACHE_HOME=$scratch LD_PRELOAD=$preload \
  GUILE_LOAD_PATH=$moddir GUILE_LOAD_COMPILED_PATH=$ccachedir GUILE_EXTENSIONS_PATH=$extensiondir \
  $GUILE -c '(use-modules (bight))' </dev/null 2>"$scratch/err"
result $? '(use-modules (bight)) works in plain guile'
empty 'and says nothing on standard error' "$scratch/err"
check 'plain guile has the language, told what bight --environment says' \
  sh -c 'eval "$("$1" --environment)" && exec "$2" -c "(use-modules (bight)) (enter! (quote tank))"' \
  sh "$bindir/bight" "$GUILE"
finish strictly
