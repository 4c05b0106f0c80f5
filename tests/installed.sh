# Run by `make installcheck': the library, the program and the modules as installed, each found only
# through what `make install' put in place.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

unset GUILE_LOAD_PATH GUILE_LOAD_COMPILED_PATH GUILE_EXTENSIONS_PATH BIGHT_UNINSTALLED BIGHT_WORLDS
GUILE_AUTO_COMPILE=0
ASAN_OPTIONS=detect_leaks=0
export GUILE_AUTO_COMPILE ASAN_OPTIONS

# Nothing below DESTDIR stands where it was configured to stand.
if [ -n "$destdir" ]; then
  echo "1..0 # SKIP installed below DESTDIR"
  exit 0
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

"$bindir/bight" -c 1 </dev/null >"$scratch/out" 2>"$scratch/err"
result $? 'bight -c 1 succeeds'
[ "$(cat "$scratch/out")" = 1 ]
result $? 'and prints 1'
empty 'and nothing on standard error' "$scratch/err"

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
finish strictly
