# The public headers and the library as programs in C11 and C++17 use them.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

strict='-Wall -Wextra -Wpedantic -Werror'
include=-I$top_srcdir/src
library="$top_builddir/src/libbight.la"
# The place of the library may hold spaces; the compilers' own settings are lists of words.
link ()
{
  "$top_builddir/libtool" --silent --tag=CC --mode=link "$@" $BT_LDFLAGS "$library" -lm
}

for header in "$top_srcdir"/src/bight/*.h; do
  name=bight/$(basename "$header")
  printf "#include <%s>\ntypedef int not_empty;\n" "$name" >"$scratch/one.c"
  cp "$scratch/one.c" "$scratch/one.cc"
  check "<$name> stands alone in C11" \
    $CC -std=c11 $strict "$include" -fsyntax-only "$scratch/one.c"
  if [ -n "$CXX" ]; then
    check "<$name> stands alone in C++17" \
      $CXX -std=c++17 $strict "$include" -fsyntax-only "$scratch/one.cc"
  else
    skip "no C++ compiler (Debian package: g++)"
  fi
done

# What a program needs to be built with bight is bight alone: nothing else is looked for, such as libgsl-dev.
flags=$(PKG_CONFIG_PATH='' PKG_CONFIG_LIBDIR=$top_builddir $PKG_CONFIG --cflags --libs bight 2>"$scratch/err")
result $? 'pkg-config tells of bight where no other library is known to it'
empty 'and misses none' "$scratch/err"
case $flags in
  *gsl* | *qhull*) result 1 "what it tells names no other library: $flags" ;;
  *-lbight*) result 0 'what it tells names no other library' ;;
  *) result 1 "what it tells names bight: $flags" ;;
esac

check 'a C11 program compiles' \
  $CC -std=c11 $strict "$include" -c "$top_srcdir/tests/consumer/consumer.c" -o "$scratch/c.o"
check 'and links' link $CC "$scratch/c.o" -o "$scratch/consumer-c"
check 'and runs' "$scratch/consumer-c"

check "the manual's program compiles" \
  $CC -std=c11 $strict "$include" -c "$top_srcdir/tests/consumer/flight.c" -o "$scratch/flight.o"
check 'and links' link $CC "$scratch/flight.o" -o "$scratch/flight"
check 'and runs' "$scratch/flight"
sed -n '/^#include <math/,$p' "$top_srcdir/tests/consumer/flight.c" >"$scratch/flight.c"
sed -n '/^@example c$/,/^@end example$/{/^@example c$/d;/^@end example$/d;s/@\([@{}]\)/\1/g;p}' \
  "$top_srcdir/doc/library.texi" >"$scratch/shown.c"
check 'and is what the manual shows' diff "$scratch/shown.c" "$scratch/flight.c"

if [ -n "$CXX" ]; then
  check 'a C++17 program compiles' \
    $CXX -std=c++17 $strict "$include" -c "$top_srcdir/tests/consumer/consumer.cc" -o "$scratch/cc.o"
  check 'and links' link $CXX "$scratch/cc.o" -o "$scratch/consumer-cc"
  check 'and runs' "$scratch/consumer-cc"
else
  skip 'no C++ compiler (Debian package: g++)'
fi
finish
