# Taking a lesson as a person does, through a pipe: typing, leaving, going on at the same point, marks in the
# logbook, a lesson that is killed.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
BIGHT_LOGBOOK=$scratch/logbook.db
XDG_STATE_HOME=$scratch/state
export BIGHT_LOGBOOK XDG_STATE_HOME

take ()
{
  "$pre" bight lesson one-pile --typed --quiet --trainee ann --group crew >"$scratch/out" 2>"$scratch/err"
}

"$pre" bight lessons --trainee ann >"$scratch/out" 2>"$scratch/err"
grep -q '^05  one-pile  *later  *One pile, out and back$' "$scratch/out"
result $? 'bight lessons lists the lessons by their titles'
awk 'length > 80 { long = 1 } END { exit long }' "$scratch/out"
result $? 'in 80 columns'
"$pre" bight lessons --skills --trainee ann | grep -q '^  one-pile  *route  *slack$'
result $? 'what each trains and needs is told with the skills'

take <<END
h
(fly-to! '(4 0 -5) #:speed 0.5)
(run 20)
(foo)
q
END
result $? 'a lesson that is left is no failure'
empty 'and nothing on standard error' "$scratch/err"
grep -q '^20.0 s> Unbound variable: foo' "$scratch/out"
result $? 'a mistake is told and the lesson goes on'
grep -q 'Hint: Choose a side' "$scratch/out"
result $? 'h gives a hint'
"$pre" bight lessons --trainee ann | grep -q '^05  one-pile  *begun'
result $? 'the list knows that it is begun'

take <<END
(fly-to! '(0 5 -5) #:speed 0.5)
(run 60)
east
(fly-to! '(4 0 -5) #:speed 0.5)
(run 20)
(fly-to! '(6 -6 -5))
(run 60)
END
result $? 'a lesson that was left goes on'
grep -q '^20.0 s> ' "$scratch/out"
result $? 'at the same point'
grep -q '^one-pile: 100 out of 100, passed' "$scratch/out"
result $? 'to its end'

if grep -q '^bight: ' "$scratch/err" || ! "$pre" bight -c '(logbook)' >/dev/null 2>&1; then
  skip 'marks in the list: no logbook here'
  skip 'marks of a group: no logbook here'
else
  "$pre" bight lessons --trainee ann | grep -q '^05  one-pile  *passed 100  *One pile, out and back$'
  result $? 'the list shows the marks'
  "$pre" bight lessons --csv --group crew | grep -q '^ann,crew,one-pile,normal,1,100,1,'
  result $? 'and a group is told as CSV'
fi

# Killed in the middle, it goes on where it was.
{ printf '%s\n' "(fly-to! '(4 0 -5) #:speed 0.5)" '(run 7)' '(kill (getpid) 9)'; } |
  "$pre" bight lesson one-pile --typed --quiet --trainee bob >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && grep -q 'signal 9' "$scratch/err"
result $? 'a lesson that is killed says so'
# What killed it is in the journal only if it came to an end: it did not.
echo q | "$pre" bight lesson one-pile --typed --quiet --trainee bob >"$scratch/out" 2>"$scratch/err"
grep -q '^7.00 s> ' "$scratch/out"
result $? 'and goes on at the same point'

"$pre" bight lesson one-pil </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && grep -q 'one-pile' "$scratch/err"
result $? 'a misspelt name is told the nearest'
"$pre" bight lesson one-pile --chek </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && grep -q 'did you mean `--check' "$scratch/err"
result $? 'so is a misspelt option'

cat >"$scratch/bad.scm" <<END
(define-lesson bad "Bad"
  (in open-water)
  (task "Nothing." (done-when #f) (hint-after 5 "Never.") (at-most 2))
  (pilot expert "Does nothing."))
END
"$pre" bight lesson --check "$scratch/bad.scm" >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && grep -q 'demonstration does not pass' "$scratch/out" && grep -q 'nobody can hear the hint: Never' "$scratch/out"
result $? 'a lesson that cannot be passed does not check'

cp "$top_srcdir/lessons/11-blind-tender.scm" "$scratch/outside.scm"
"$pre" bight lesson --check "$scratch/outside.scm" >"$scratch/out" 2>"$scratch/err"
result $? 'a lesson with messages checks from outside as well'
for pilot in expert ordinary careless; do
  for seed in 1 2; do
    grep "^$pilot, seed $seed: [0-9]* out of 100, " "$scratch/out"
  done
done >"$scratch/flights"
[ "$(grep -c '^expert.* passed$' "$scratch/flights")" -eq 2 ] && [ "$(grep -c '^ordinary' "$scratch/flights")" -eq 2 ] &&
  [ "$(grep -c '^careless.* not passed$' "$scratch/flights")" -eq 2 ]
result $? 'and all of its pilots are flown, each twice, and told'

# Which comes next, and why.
"$pre" bight lesson --trainee newcomer >"$scratch/out" 2>"$scratch/err"
if grep -q '^There is no record' "$scratch/out"; then
  grep -q '^bight lesson read-the-bow$' "$scratch/out"
  result $? 'without a record the first lesson is proposed'
else
  grep -q '^Next: read-the-bow' "$scratch/out" && grep -q 'trains bow' "$scratch/out"
  result $? 'bight lesson alone proposes the next and says why'
fi

# An experiment: consent, the draw, the first step.
if grep -q '^There is no record' "$scratch/out"; then
  skip 'consent: no logbook here'
  skip 'the first step: no logbook here'
else
  echo no | "$pre" bight experiment --trainee p1 >"$scratch/out" 2>"$scratch/err"
  grep -q '^Taking part is voluntary' "$scratch/out" && grep -q '^Nothing is kept of you' "$scratch/out" &&
    "$pre" bight experiment --table | grep -q '^0 took part'
  result $? 'who does not consent takes no part'
  echo yes | "$pre" bight experiment --trainee p1 >"$scratch/out" 2>"$scratch/err"
  grep -q '^Step 1 of 5: which-side-of-the-leg' "$scratch/out" && grep -q 'You fly without' "$scratch/out" &&
    "$pre" bight experiment --table | grep -q '^1 took part'
  result $? 'who does flies the test first, without a display'
fi

# What a lesson hides is hidden at its prompt.
"$pre" bight lesson blind-tender --typed --quiet --trainee eve >"$scratch/out" 2>"$scratch/err" <<END
(slack)
l
t give 5
(run 2)
(payout-counter)
(rov-depth)
q
END
[ "$(grep -c 'you cannot see that from where you are' "$scratch/out")" -eq 3 ] && grep -q '8.0$' "$scratch/out"
result $? 'what a lesson hides its pupil cannot ask'
grep -q '^Tender: Giving' "$scratch/out"
result $? 'and hears what the tender answers'

finish
