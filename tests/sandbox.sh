# A lesson from outside is enclosed in a process: what its language cannot stop ends by a limit, in one
# clear line, and writes nowhere.  What the language itself refuses is in tests/scheme/sandbox.scm.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

if [ "$sanitize" = yes ]; then
  skip "the sanitizers want more memory than a lesson from outside gets"
  finish
fi

pre=$top_builddir/pre-inst-env
BIGHT_LESSON_SECONDS=2
BIGHT_LESSON_MEGABYTES=160
BIGHT_LOGBOOK=$scratch/logbook.db
XDG_STATE_HOME=$scratch/state
export BIGHT_LESSON_SECONDS BIGHT_LESSON_MEGABYTES BIGHT_LOGBOOK XDG_STATE_HOME

# lesson FORM: a lesson whose task begins with FORM, and is done when CONDITION.
lesson ()
{
  cat >"$scratch/lesson.scm" <<END
(define (sum-of numbers) (apply + numbers))
(define-lesson outside "From outside"
  (in (world (sea (depth 20)) (rov (at 0 5 -5)) (tether (wet-weight 0) (from 0 0 -2) (to rov) (length 12))))
  (set-up $1)
  (task "Wait." (done-when $2) (at-most 10))
  (pilot expert "Waits." (flies (drive! #:surge 0.1))))
END
  "$pre" bight lesson "$scratch/lesson.scm" --pilot expert </dev/null >"$scratch/out" 2>"$scratch/err"
}

# ended NAME FORM CONDITION PATTERN: the lesson fails, and says why.
ended ()
{
  lesson "$2" "$3"
  status=$?
  if [ $status -eq 1 ] && grep -q "^bight: .*$4" "$scratch/err"; then
    result 0 "$1"
  else
    result 1 "$1"
    diag "status $status" "$(head -c 2000 "$scratch/err")"
  fi
}

lesson '(sum-of (list 1 2 3))' '(> (now) 1)'
result $? 'a harmless lesson, with a helper of its own, runs'
grep -q 'outside: 100 out of 100, passed' "$scratch/out"
result $? 'and is marked'

ended 'a loop without end' '(let loop () (loop))' '#t' 'processor time'
ended 'a loop in a condition' '1' '(let loop () (loop))' 'processor time'
ended 'a sum without end' '(let loop ((n 1.5)) (loop (+ n 1)))' '#t' 'processor time'
ended 'a list without end' '(let loop ((l (list 1))) (loop (cons 1 l)))' '#t' '\(memory\|overflow\)'
ended 'a recursion without end' '(let loop ((n 0)) (+ 1 (loop n)))' '#t' '\(memory\|overflow\)'
ended 'a mistake that is an error' '(car 1)' '#t' 'car'

# Trusted, the same file may do as it likes.
cat >"$scratch/lesson.scm" <<END
(call-with-output-file "$scratch/written" (lambda (port) (write 1 port)))
(define-lesson outside "From outside"
  (in open-water) (task "Wait." (done-when (> (now) 1))) (pilot expert "Waits."))
END
"$pre" bight lesson "$scratch/lesson.scm" --pilot expert </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && [ ! -e "$scratch/written" ]
result $? 'a file from outside writes nothing'
"$pre" bight lesson "$scratch/lesson.scm" --trust --pilot expert </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 0 ] && [ -e "$scratch/written" ]
result $? 'trusted, it may'

# What the language does not stop, the kernel does.
cat >"$scratch/kernel.scm" <<END
(use-modules (bight sandbox))
(display (enclose!))
(newline)
(force-output)
(false-if-exception (call-with-output-file "$scratch/stolen" (lambda (port) (write 1 port))))
(false-if-exception (system* "touch" "$scratch/stolen"))
(false-if-exception (delete-file "$scratch/lesson.scm"))
(false-if-exception (mkdir "$scratch/stolen"))
END
how=$("$pre" bight "$scratch/kernel.scm" 2>/dev/null </dev/null | head -n 1)
if [ "$how" = kernel ]; then
  [ ! -e "$scratch/stolen" ] && [ -e "$scratch/lesson.scm" ]
  result $? 'an enclosed process makes, changes, starts and removes nothing'
else
  skip 'an enclosed process makes, changes, starts and removes nothing: no Landlock here'
fi

finish
