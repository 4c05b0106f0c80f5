# The files of doc/ci do what they say: the lines that they run are taken from them and run, in their order, in a
# copy of a user's project.  Getting and building bight is left out: the build that is tested stands in for it.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/sweeps.sh"

ci=$top_srcdir/doc/ci

# ---- A project with two scenarios, one of which fails ----

mkdir -p project/tests origin/build
cat >project/tests/bay.scm <<'SCM'
(define-scenario line-holds
  "The line holds."
  (in open-water)
  (expect (parted?) => #f))
(define-scenario line-is-short
  "It is not."
  (in open-water)
  (expect (tether-length) is (below 1)))
SCM

# What is cloned in place of bight: its bootstrap makes what leads to the build at hand.
printf '#!/bin/sh\nprintf built >"$(dirname "$0")/built"\n' >origin/bootstrap
printf '#!/bin/sh\nexec %s "$@"\n' "$pre" >origin/build/pre-inst-env
chmod +x origin/bootstrap origin/build/pre-inst-env
if ! command -v git >/dev/null; then
  skip 'there is no git'
  finish
fi
(cd origin && git init -q && git add . &&
  git -c user.name=nobody -c user.email=nobody@localhost commit -q -m bight) >git.log 2>&1
result $? 'something to clone stands in for bight'
BIGHT_SOURCE=file://$scratch/origin
export BIGHT_SOURCE

# Lines of a workflow, one a line, without what installs packages.
github_lines ()
{
  sed -n 's/^ *run: //p' "$ci/github.yml" | grep -v '^apt-get'
}
gitlab_lines ()
{
  awk '/^  [a-z_]*:/ { on = /script:$/ } on && sub (/^    - /, "")' "$ci/gitlab.yml" | grep -v '^apt-get'
}

# follow NAME: run the lines of the workflow NAME.
follow ()
{
  rm -rf work
  cp -r project work
  "$1_lines" >"$1.lines"
  [ "$(wc -l <"$1.lines")" -eq 2 ]
  result $? "$1: two lines are run besides packages"
  (cd work && sh -e -c "$(sed -n 1p "../$1.lines")") >"$1.log" 2>&1 && [ -f work/bight/built ]
  result $? "$1: bight is cloned and built"
  (cd work && HOME=$scratch sh -e -c "$(sed -n 2p "../$1.lines")") >"$1.out" 2>&1
  [ $? -eq 1 ]
  result $? "$1: a scenario that fails is a job that fails"
  grep -q 'testcase.*line-holds' work/report.xml && grep -q 'file="[^"]*bay.scm"' work/report.xml &&
    grep -q 'line="5"' work/report.xml && [ "$(grep -c '<failure' work/report.xml)" -eq 1 ]
  result $? "$1: the report names both, and file and line"
  grep -q "$(sed -n 's/^ *\(path\|junit\): //p' "$ci/$1.yml")" "$1.lines"
  result $? "$1: the report that is kept is the one that is written"
}
follow github
follow gitlab

# They are YAML, as far as there is somebody to ask.
for file in github gitlab; do
  if python3 -c 'import yaml' 2>/dev/null; then
    python3 -c 'import sys, yaml; assert yaml.safe_load (open (sys.argv[1]))' "$ci/$file.yml"
    result $? "$file.yml is YAML"
  else
    skip 'there is no YAML in Python'
  fi
done

# ---- A sweep with Snakemake ----

begin_study
cp quick.scm study.scm
mkdir bin
printf '#!/bin/sh\nexec %s bight "$@"\n' "$pre" >bin/bight
chmod +x bin/bight
PATH=$scratch/bin:$PATH

# shell_of RULE: what it runs, as written.
shell_of ()
{
  sed -n "/^rule $1:/,/^\$/s/^ *shell: \"\(.*\)\"\$/\1/p" "$ci/Snakefile"
}
parts=$(sed -n 's/^PARTS = //p' "$ci/Snakefile")
mkdir parts
whole=
for part in $(seq "$parts"); do
  sh -e -c "$(shell_of part | sed "s,{input},study.scm,; s,{wildcards.part},$part,; s,{params.parts},$parts,
    s,{output},parts/$part.db,")" >part.log 2>&1 || diag "$(cat part.log)"
  whole="$whole parts/$part.db"
done
sh -e -c "$(shell_of merge | sed "s,{output},result.db,; s,{input},$whole,")" >merge.log 2>&1
result $? "Snakefile: $parts parts are flown and merged"
sh -e -c "$(shell_of table | sed 's,{input},result.db,; s,{output},result.csv,')"
[ "$(wc -l <result.csv)" -gt 1 ]
result $? 'Snakefile: the table is written'
bight sweep quick.scm -o result.db | grep -q "12 done (0 now), fingerprint $one"
result $? 'and is that of one process'
if command -v snakemake >/dev/null; then
  mkdir snake
  cp study.scm "$ci/Snakefile" snake
  (cd snake && HOME=$scratch snakemake -j 2) >snake.log 2>&1 && cmp -s snake/result.csv result.csv
  result $? 'Snakemake itself comes to the same'
else
  skip 'there is no snakemake'
fi
finish
