# The language in a plain guile, where bight is only a module among others.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

guile ()
{
  "$top_builddir/pre-inst-env" $GUILE "$@" </dev/null >"$scratch/out" 2>"$scratch/err"
}

guile -c "(use-modules (bight)) (display 'ready)"
result $? '(use-modules (bight)) works'
[ "$(cat "$scratch/out")" = ready ]
result $? 'and prints nothing of its own'
empty 'and says nothing on standard error' "$scratch/err"

# A name that hides one of Guile's warns, once somebody uses both.
guile -c "(use-modules (bight) (srfi srfi-1) (ice-9 match) (ice-9 format)) (display 'ready)"
result $? '(bight) goes with srfi-1, match and format'
empty 'without a warning' "$scratch/err"

guile -c "(use-modules (bight) (srfi srfi-1)) (enter! 'tank) (every 1 (now)) (run 1)"
result $? 'every is that of bight, beside srfi-1'
empty 'without a warning' "$scratch/err"
# As after `make install' to a prefix that Guile does not know: what the three variables are is asked of bight.
"$top_builddir/pre-inst-env" sh -c '
  told=$(bight --environment) || exit 1
  unset GUILE_LOAD_PATH GUILE_LOAD_COMPILED_PATH GUILE_EXTENSIONS_PATH
  GUILE_LOAD_PATH="/of/my own"
  export GUILE_LOAD_PATH
  eval "$told"
  exec "$@"' sh $GUILE -c "(use-modules (bight)) (enter! 'tank) (display (last-pair %load-path))
    (display (member \"/of/my own\" %load-path))" </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 0 ] && grep -q '(/of/my own ' "$scratch/out"
told=$?
result $told 'bight --environment tells what plain guile needs to find it, beside what one has'
[ $told -eq 0 ] || sed 's/^/# /' "$scratch/err"
finish
