# The manual tells the truth: every public name says what it is, what is made from the program is as the
# program is now, every law has its number and its tests, and makeinfo finds nothing to say.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
doc=$top_srcdir/doc
made=$top_builddir/doc

# ---- Names say what they are ----

"$pre" bight "$doc/reference.scm" --check </dev/null >"$scratch/mute" 2>&1
empty 'every name of the language has a docstring' "$scratch/mute"

headers=$(sed -n "s,^#include <\(bight/.*\)>,$top_srcdir/src/\1,p" "$top_srcdir/src/bight/bight.h")
# shellcheck disable=SC2086 # a list of files without spaces
awk -v check=1 -f "$doc/headers.awk" $headers >"$scratch/mute"
empty 'every public function has a comment' "$scratch/mute"

# ---- What is made is as it would be made now ----

same ()
{
  cmp -s "$2" "$made/$1" || diff "$made/$1" "$2" >"$scratch/stale" 2>&1
  result $? "$1 is up to date"
  [ ! -s "$scratch/stale" ] || diag "$(head -n 20 "$scratch/stale")"
  : >"$scratch/stale"
}

"$pre" bight "$doc/reference.scm" </dev/null >"$scratch/names.texi"
same names.texi "$scratch/names.texi"
# shellcheck disable=SC2086
awk -f "$doc/headers.awk" $headers >"$scratch/headers.texi"
same headers.texi "$scratch/headers.texi"

"$pre" bight -c '(for-each (lambda (name) (display name) (newline)) (language-names))' </dev/null |
  while read -r name; do
    grep -qF -e "} $name " -e "@defvr {Value} $name" "$made/names.texi" || echo "$name"
  done >"$scratch/missing"
empty 'every name of the language is in the manual' "$scratch/missing"

if [ -f "$made/bight.info" ]; then
  sed -n 's/^@findex //p' "$made/headers.texi" | sort -u | while read -r name; do
    grep -qF "$name" "$made/bight.info" || echo "$name"
  done >"$scratch/missing"
  empty 'every public function is in bight.info' "$scratch/missing"
  [ -z "$(find "$doc" -name '*.texi' -newer "$made/bight.info")" ]
  result $? 'bight.info is younger than its chapters'
else
  skip 'there is no bight.info: makeinfo (Debian package: texinfo) was missing'
  skip 'there is no bight.info'
fi

# ---- Laws and their tests ----

sed -n 's/^@law{\([0-9]*\),.*/\1/p' "$doc/physics.texi" >"$scratch/laws"
seq "$(wc -l <"$scratch/laws")" >"$scratch/numbers"
[ -s "$scratch/laws" ] && cmp -s "$scratch/laws" "$scratch/numbers"
result $? 'the laws are numbered one after another'

# A law goes on to the next one; each has a source and a test.
awk '/^@law\{/ { if (law && !(source && held)) print law; law = $0; source = held = 0 }
     /^Source: / { source = 1 }
     /@heldby\{/ { held = 1 }
     END { if (!(source && held)) print law }' "$doc/physics.texi" >"$scratch/poor"
empty 'every law names its source and its tests' "$scratch/poor"

# held FILE NAME: whether the test NAME stands in FILE, and FILE among those that are run.
held ()
{
  grep -qE "^  (${1%.c}|$1)( |\$)" "$top_srcdir/tests/Makefile.am" || return 1
  case $1 in
    *.scm) grep -qE "^\(define-scenario \(?$2[ )]*(\$| )" "$top_srcdir/tests/$1" ;;
    *) # Defined, and in the list of tests.
      grep -qE "^$2 \(void" "$top_srcdir/tests/$1" \
        && grep -qE "(cmocka_unit_test[a-z_]* \(|LAW \(|[{(, ])$2[,) ]" "$top_srcdir/tests/$1" ;;
  esac
}

tr '\n' ' ' <"$doc/physics.texi" >"$scratch/text"
tr '\n' ' ' <"$doc/thesis.texi" >>"$scratch/text"
grep -oE '@heldby\{[^}]*\}' "$scratch/text" | sed 's/@heldby{//; s/}//; s/, */ /' | sort -u |
  while read -r file name; do
    held "$file" "$name" || echo "there is no test $name in tests/$file"
  done >"$scratch/missing"
empty 'the tests that the manual names are there' "$scratch/missing"

# Sections, figures and equations of the thesis that the chapter beside it must not forget.
for figure in 1-1 1-2 1-3 2-1 2-2 2-3 2-4 3-1 3-2 3-3 3-4 3-5 3-6 3-7 3-8 B-1 B-2 B-3 B-4; do
  grep -qE "^@item Figures?.*$figure" "$doc/thesis.texi" || echo "figure $figure"
done >"$scratch/missing"
empty 'every figure of the thesis stands beside ours' "$scratch/missing"

# ---- The manual page ----

"$pre" bight --help all </dev/null | grep -oE '(^|[ [])-{1,2}[a-zA-Z][a-z-]*' | tr -d ' [' | sort -u |
  while read -r option; do
    sed 's/\\-/-/g' "$made/bight.1" | grep -qF -e "$option" || echo "$option"
  done >"$scratch/missing"
empty 'the manual page names every option' "$scratch/missing"

if (groff --version) >/dev/null 2>&1; then
  groff -man -ww -b -z "$made/bight.1" >"$scratch/said" 2>&1
  empty 'groff has nothing to say about it' "$scratch/said"
else
  skip 'there is no groff'
fi

# ---- The whole, as HTML ----

if (makeinfo --version) >/dev/null 2>&1; then
  makeinfo -D 'VERSION 0' -I "$made" -I "$doc" --html -o "$scratch/html" "$doc/bight.texi" >"$scratch/said" 2>&1
  empty 'makeinfo has nothing to say about it' "$scratch/said"
  [ -s "$scratch/html/index.html" ]
  result $? 'and makes pages'
  "$pre" bight "$doc/search-index.scm" "$scratch/html" >"$scratch/index.js" 2>"$scratch/err"
  pages=$(find "$scratch/html" -name '*.html' | wc -l)
  named=$(grep -oE '[[]"[^"]*[.]html","[^"]+","[^"]+"' "$scratch/index.js" | wc -l)
  [ "$pages" -gt 100 ] && [ "$pages" -eq "$named" ] && [ ! -s "$scratch/err" ]
  result $? 'each of them can be found by its title and its words'
  empty 'what is found is text' "$(grep -oE '<(div|a|p|span)[ >]' "$scratch/index.js" >"$scratch/tags"; echo "$scratch/tags")"
else
  skip 'there is no makeinfo (Debian package: texinfo)'
  skip 'there is no makeinfo'
  skip 'there is no makeinfo'
  skip 'there is no makeinfo'
fi

# ---- The Debian package ----

if [ -f "$top_srcdir/debian/control" ]; then
  { sed -n "/^packages='/,/'\$/p" "$top_srcdir/bootstrap" | grep -oE '[a-z0-9.-]+-dev' | grep -v '^libc6'
    sed -n "s/^test_packages='\(.*\)'/\1/p" "$top_srcdir/bootstrap" | tr ' ' '\n' | sed 's/|.*//'; } |
    while read -r package; do
      grep -qE "^ $package( |,|\$)" "$top_srcdir/debian/control" || echo "$package"
    done >"$scratch/missing"
  empty 'debian/control names the libraries and the tools of tests that bootstrap installs' "$scratch/missing"
else
  skip 'there is no folder debian here'
fi
finish
