# Does the engine compute the same whoever compiles it, and nothing that is no number?
# In short: a fixed set of cases comes to the same twice, and nothing in it is invalid, divides by zero or
# overflows, where the processor can trap that.  BIGHT_LONG=1: gcc and clang, unoptimised and optimised, their
# sanitizers, and valgrind, each over an engine built for it (a quarter of an hour).  AGREE_JOBS=N: N compilers
# at once; AGREE_DIR=DIR: what they make is kept there.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

program=$top_builddir/bench/bight-bench-stability

# same NAME FILE...: passes when all are the same and not empty.
same ()
{
  same_name=$1
  first=$2
  shift
  status=0
  for file; do
    [ -s "$file" ] && cmp -s "$first" "$file" || status=1
  done
  result $status "$same_name"
  [ $status -eq 0 ] || for file; do diag "$file"; diag "$(cat "$file")"; done
}

"$program" --agree >"$scratch/once" 2>"$scratch/err"
result $? 'a fixed set of cases of every family runs'
diag "$(cat "$scratch/once" "$scratch/err")"
"$program" --agree >"$scratch/again" 2>&1
same 'and comes to the same again, bit for bit' "$scratch/once" "$scratch/again"
grep -q 'faults=[1-9]' "$scratch/once"
[ $? -ne 0 ]
result $? 'without a fault'

"$program" --traps >"$scratch/traps" 2>&1
case $?:$(cat "$scratch/traps") in
  *'cannot trap'*) skip 'no traps on this system' ;;
  0:*) result 0 'no operation is invalid, divides by zero or overflows' ;;
  *)
    result 1 'no operation is invalid, divides by zero or overflows'
    diag "$(cat "$scratch/traps")"
    ;;
esac

if [ "${BIGHT_LONG:-}" != 1 ]; then
  finish
fi

# ---- Other builds ----

cd "$top_srcdir" || exit 1
folder=${AGREE_DIR:-$scratch}
packages='gsl qhull_r'
libraries=$($PKG_CONFIG --libs $packages)
sources=$(sed -n '/^libbight_core_la_SOURCES/,/[^\\]$/p' src/Makefile.am | grep -o '[a-z_/]*\.c' |
  sed 's|^|src/|')
sources="$sources $(ls bench/stability*.c testbed/campaign*.c) bench/options.c bench/row.c"
for name in calibration chance contact_judge contact_scene gallery reef_world scene solids sweep; do
  sources="$sources testbed/$name.c"
done
sources="$sources $top_builddir/testbed/gallery_worlds.c"

# build NAME COMPILER FLAG...: the program $folder/NAME/agree; false when that cannot be.
build ()
{
  dir=$folder/$1
  compiler=$2
  shift 2
  mkdir -p "$dir"
  # A file of options, for the sake of its quotes.
  cat >"$dir/options" <<EOF
-std=c11 -g -ffp-contract=off -D_GNU_SOURCE -DBENCH_FLAGS=\\"\\" -DBIGHT_LIBEXEC_DIR=\\"\\"
-I. -Isrc -Ibench -I"$top_builddir" $($PKG_CONFIG --cflags $packages) $*
EOF
  export compiler dir
  printf '%s\n' $sources | xargs -n 1 -P "${AGREE_JOBS:-1}" sh -c \
    'exec $compiler @"$dir/options" -c "$0" -o "$dir/$(echo "$0" | tr / _).o"' >"$dir/log" 2>&1 &&
    $compiler "$@" "$dir"/*.o $libraries -lm -o "$dir/agree" >>"$dir/log" 2>&1
}

# try NAME COMPILER FLAG...: build it, and run it into $folder/NAME/out.
try ()
{
  name=$1
  if ! command -v "$2" >/dev/null; then
    skip "$name: no $2 here"
    return
  fi
  if ! build "$@"; then
    result 1 "$name is built"
    diag "$(tail -n 20 "$folder/$name/log")"
    return
  fi
  "$folder/$name/agree" --agree >"$folder/$name/out" 2>"$folder/$name/err"
  result $? "$name runs"
  diag "$(cat "$folder/$name/err" "$folder/$name/out")"
}

sanitizers='-fsanitize=address,undefined -fno-sanitize-recover=undefined'
for compiler in gcc clang; do
  for level in 0 2 3; do
    try "$compiler-O$level" $compiler -O$level
  done
  try "$compiler-sanitized" $compiler -O1 $sanitizers
done
if command -v valgrind >/dev/null && [ -x "$folder/gcc-O2/agree" ]; then
  mkdir -p "$folder/valgrind"
  valgrind -q --error-exitcode=9 "$folder/gcc-O2/agree" --agree >"$folder/valgrind/out" 2>"$folder/valgrind/err"
  result $? 'valgrind finds nothing'
  diag "$(cat "$folder/valgrind/err")"
else
  skip 'no valgrind, or no gcc, here'
fi
for name in gcc-O0 clang-O3; do
  if [ -x "$folder/$name/agree" ]; then
    "$folder/$name/agree" --traps >"$scratch/traps" 2>&1
    result $? "$name: nor is any operation invalid there"
    diag "$(cat "$scratch/traps")"
  fi
done

# What NAMEs came to, those that ran.
outputs ()
{
  for name; do
    [ -s "$folder/$name/out" ] && echo "$folder/$name/out"
  done
}

for compiler in gcc clang; do
  names="$compiler-O0 $compiler-O2 $compiler-O3 $compiler-sanitized"
  [ $compiler = clang ] || names="$names valgrind"
  outputs $names | grep -q . &&
    same "$compiler: the same bits whatever it optimises, sanitized or under valgrind" $(outputs $names)
done
same 'as this build: the same bits' "$scratch/once" $(outputs gcc-O2 clang-O2)
finish
