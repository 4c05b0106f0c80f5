# The tree of a large bed is kept where a user's cache is, and used again; a world without one keeps nothing.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

unset BIGHT_TREES
XDG_CACHE_HOME=$scratch/cache
export XDG_CACHE_HOME

# A bed of SIDE by SIDE posts, in $scratch/NAME.asc.
bed ()
{
  awk -v side="$2" 'BEGIN {
    print "ncols", side; print "nrows", side; print "xllcorner", -side / 2; print "yllcorner", -side / 2; print "cellsize 1"
    for (i = 0; i < side; i++) {
      for (j = 0; j < side; j++) printf "%d ", -26 + (i * 7 + j * 3) % 5
      print "" } }' >"$scratch/$1.asc"
}

# The state after a line was laid on that bed.
state ()
{
  "$top_builddir/pre-inst-env" bight -c "(enter! (world (sea (depth 40) (current 0.2 90)) (seabed (grid \"$scratch/$1.asc\"))
    (rov (at 0 10 -16)) (tether (from 0 0 -17) (length 14) (model dynamic)))) (run 5) (display (state-hash))" </dev/null
}

# As many files as $1 in the cache.
kept ()
{
  [ "$(find "$XDG_CACHE_HOME" -type f 2>/dev/null | wc -l)" -eq "$1" ]
}

bed large 130
bed small 60
state small >"$scratch/out"
result $? 'a dive over a small bed'
kept 0
result $? 'keeps nothing'
state large >"$scratch/first" && [ -s "$scratch/first" ]
result $? 'a dive over a large bed'
kept 1
result $? 'keeps its tree'
tree=$(find "$XDG_CACHE_HOME/bight/trees" -name '*.tree')
state large >"$scratch/second"
check 'from that tree comes the same state' cmp "$scratch/first" "$scratch/second"
printf 'other' | dd of="$tree" bs=1 seek=3000 conv=notrunc 2>/dev/null
state large >"$scratch/second"
check 'as it does where the tree was spoilt' cmp "$scratch/first" "$scratch/second"
rm -rf "$XDG_CACHE_HOME"
: >"$XDG_CACHE_HOME"
state large >"$scratch/second" 2>"$scratch/err"
check 'and where none can be kept' cmp "$scratch/first" "$scratch/second"
empty 'of which nothing is said' "$scratch/err"
rm "$XDG_CACHE_HOME"
BIGHT_TREES='' state large >"$scratch/second"
kept 0
result $? 'BIGHT_TREES, empty, keeps none'
finish
