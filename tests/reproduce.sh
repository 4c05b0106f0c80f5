# What a campaign finds can be had again: each case by its number, and as a scenario that fails.
# The faults are planted: a tension that any line reaches counts as one, or the guard is taken away.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

program=$top_builddir/bench/bight-bench-stability

# told FAMILY NUMBER LIMIT NAME: the case, which is tighter than LIMIT N, becomes a scenario, which fails for that,
# and does not when it may be a thousand times as tight.
told ()
{
  "$program" --family "$1" --seed 1 --case "$2" --tension "$3" --log "$scratch" >"$scratch/rows" 2>"$scratch/err"
  [ $? -eq 1 ] && grep -q "$1 case $2: too tight; again with --family $1 --seed 1 --case $2" "$scratch/err"
  result $? "$4: a tension above $3 N is a fault, told by its number"
  file=$scratch/$1-1-$2.scm
  "$top_builddir/pre-inst-env" bight test "$file" >"$scratch/out" 2>&1
  [ $? -eq 1 ] && grep -q "^not ok .*$1-1-$2" "$scratch/out" && grep -q "max-tension.*$3" "$scratch/out"
  result $? 'as a scenario it fails in a dive'
  [ $failures -eq 0 ] || diag "$(cat "$scratch/err" "$file" "$scratch/out")"
  sed -i "s/(<= (max-tension) $3)/(<= (max-tension) ${3}000)/" "$file"
  "$top_builddir/pre-inst-env" bight test "$file" >"$scratch/out" 2>&1
  result $? 'where it may be a thousand times as tight it passes'
  [ $failures -eq 0 ] || diag "$(cat "$scratch/out")"
}

told dynamics 35 180 'a line by itself'
told contact 16 150 'a line in rigging'

"$program" --replay "$scratch/flight-1-35.txt" >"$scratch/out" 2>&1
result $? 'the line by itself is sound, but for the planted fault'

# Without the guard whoever means harm gets through, and the judge says so.
for number in 5 7; do
  "$program" --family contact --seed 1 --case $number --mutant --log "$scratch" >"$scratch/rows" 2>"$scratch/err"
  [ $? -eq 1 ] && grep -q "contact case $number: crossing" "$scratch/err"
  result $? "case $number without the guard: a crossing is noticed"
  grep -q "^;;; Exactly: .* --family contact --seed 1 --case $number --mutant" "$scratch/contact-1-$number.scm"
  result $? 'what has no words in the language says how it is repeated'
done
finish
