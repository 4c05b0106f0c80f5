# What the engine's object code shows: only bt_ names, no way out of the process, no global state.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

shared=$top_builddir/src/.libs/libbight.so
core=$top_builddir/src/.libs/libbight-core.a

$NM -D --defined-only "$shared" | awk '{ print $NF }' >"$scratch/exported"
grep -q '^bt_' "$scratch/exported"
result $? 'libbight exports something'
grep -v '^bt_[^_]' "$scratch/exported" >"$scratch/foreign"
empty 'libbight exports bt_ names alone' "$scratch/foreign"

# What a package says of the library's symbols is what there is; the line that writes it anew is told.
(
  echo 'libbight.so.0 libbight0 #MINVER#'
  sort "$scratch/exported" | sed 's/.*/ &@Base 0.1.0/'
) >"$scratch/symbols"
kept=$top_srcdir/debian/libbight0.symbols
if [ ! -f "$kept" ]; then
  skip 'the packaging is not in a distribution'
elif cmp -s "$scratch/symbols" "$kept"; then
  result 0 'debian/libbight0.symbols lists them'
else
  result 1 'debian/libbight0.symbols lists them'
  diag "$(diff "$kept" "$scratch/symbols")"
  diag "to have it as it is: BIGHT_WRITE=1 make check TESTS=symbols.sh"
  [ -z "${BIGHT_WRITE:-}" ] || cp "$scratch/symbols" "$kept"
fi

$NM -A -u "$core" | sed 's/@.*//' | awk '{ print $1, $NF }' >"$scratch/needed"
for name in exit _exit _Exit quick_exit abort __assert_fail \
            printf vprintf puts putchar fprintf vfprintf fputs fputc putc fwrite perror psignal \
            __printf_chk __vprintf_chk __fprintf_chk __vfprintf_chk stdout stderr; do
  awk -v name="$name" '$2 == name' "$scratch/needed" >>"$scratch/used"
done
empty 'the engine never exits, aborts, asserts or prints' "$scratch/used"

if [ "$sanitize" = yes ] || [ "$OBJDUMP" = : ]; then
  skip 'writable data cannot be told apart here'
else
  # Objects with a size in .data, .bss, thread-local or common storage.
  $OBJDUMP -t "$core" \
    | awk '/file format/ { file = $1 }
           / O / && / (\.data|\.bss|\.tdata|\.tbss)(\.[^ \t]*)?[ \t]/ && !/ \.data\.rel\.ro/ { print file, $NF }
           / \*COM\*/ { print file, $NF }' >"$scratch/globals"
  empty 'the engine has no writable global' "$scratch/globals"
fi
finish
