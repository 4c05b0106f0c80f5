# Every example in the README and in the manual does what it says; see documents.scm.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
XDG_STATE_HOME=$scratch/state # not everybody has a home
export XDG_STATE_HOME

# How a program in C is built and run.
cat >"$scratch/run-c" <<RUN
"$top_builddir/libtool" --silent --tag=CC --mode=compile $CC -std=c11 -Wall -Wextra -Werror \\
  "-I$top_srcdir/src" -c "\$1" -o example.lo >/dev/null \\
  && "$top_builddir/libtool" --silent --tag=CC --mode=link $CC example.lo $BT_LDFLAGS \\
    "$top_builddir/src/libbight.la" -lm -o example \\
  && ./example
RUN
RUN_C="sh $scratch/run-c"
export RUN_C

# Each document is a session in a folder of its own; what it says is counted here.
for document in README.md doc/tutorial.texi doc/fly.texi doc/physics.texi doc/language.texi doc/files.texi doc/program.texi doc/sweep.texi \
                doc/library.texi doc/extending.texi doc/limits.texi doc/beside.texi doc/thesis.texi doc/jobs.texi doc/editor.texi; do
  mkdir -p "$scratch/there"
  (cd "$scratch/there" && "$pre" bight "$top_srcdir/tests/documents.scm" "$top_srcdir/$document") \
    >"$scratch/said" 2>"$scratch/err" </dev/null
  result $? "the examples of $document are tried"
  [ ! -s "$scratch/err" ] || diag "$(cat "$scratch/err")"
  cat "$scratch/said"
  tests=$((tests + $(grep -cE '^(not )?ok ' "$scratch/said")))
  rm -rf "$scratch/there"
done
finish
