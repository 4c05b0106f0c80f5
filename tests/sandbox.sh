# A lesson or a world from outside is enclosed in a process: what its language cannot stop ends by a limit,
# in one clear line, and writes nowhere.  What the language itself refuses is in tests/scheme/sandbox.scm.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

if [ "$sanitize" = yes ]; then
  skip "the sanitizers want more memory than a lesson from outside gets"
  finish
fi

pre=$top_builddir/pre-inst-env
# Processor time costs more of itself on a busy machine: what does not end by its limit is given plenty.
plenty=300
little=2
BIGHT_LESSON_SECONDS=$plenty
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

BIGHT_LESSON_SECONDS=$little
ended 'a loop without end' '(let loop () (loop))' '#t' 'processor time'
ended 'a loop in a condition' '1' '(let loop () (loop))' 'processor time'
ended 'a sum without end' '(let loop ((n 1.5)) (loop (+ n 1)))' '#t' 'processor time'
ended 'a list without end' '(let loop ((l (list 1))) (loop (cons 1 l)))' '#t' '\(memory\|overflow\|processor time\)'
BIGHT_LESSON_SECONDS=$plenty
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

# A world from outside comes as data.
cat >"$scratch/pond.scm" <<'END'
(define (row n)
  (map (lambda (i) (part cylinder (named ,(if (= i 0) 'a 'b)) (from i 2 0) (to i 2 -9) (radius 0.1))) n))
(define-tether-type string "Thin." (diameter 0.002) (mass 0.01))
(define-world puddle "Not the last." (sea (depth 1)))
(define-world pond "A pönd."
  (sea (depth 20) (current (profile (0 .3 90) (-20 .1 45)))) (seabed (grid "bottom.asc"))
  (splice (row '(0 3))) (box (named boat) (size 1 1 1) (track (0 9 9 -1) (9 9 9 -5 30))) (rov (named m) (at 1 5 -5))
  (tether (type string) (wet-weight 0) (from 1 0 -2) (to m) (via (1 1 -3) (1 2 -4)) (length 12)))
END
cat >"$scratch/bottom.asc" <<'END'
ncols 2
nrows 2
xllcorner -50
yllcorner -50
cellsize 100
-20 -20
-20 -20
END
pond=$scratch/pond.scm
expression="(use-modules (bight world)) (define a (find-world \"$pond\")) (define b (find-world \"$pond\" #:trust #t))
  (display (list (equal? (object->string (world->parts a)) (object->string (world->parts b)))
                 (world-name a) (world-documentation a) (equal? (world-file a) \"$pond\")))
  (begin (enter! \"$pond\") (display (rov-position)))"
[ "$("$pre" bight -c "$expression" 2>&1 | head -n 1)" = '(#t pond A pönd. #t)#f64(1.0 5.0 -5.0)' ]
result $? 'a world from outside is the same as the trusted one, and reads the files beside it'

# refused NAME PATTERN FORM: a world file with FORM on its second line is refused, with a line that says why.
refused ()
{
  printf '(define-world w "W." (sea (depth 9)))\n%s\n' "$3" >"$scratch/world.scm"
  (cd "$scratch" && "$pre" bight -c '(enter! "world.scm")' </dev/null >out 2>err)
  status=$?
  if [ $status -eq 1 ] && [ "$(wc -l <"$scratch/err")" -eq 1 ] && grep -q "^bight: enter!: world.scm:.*$2" "$scratch/err"; then
    result 0 "a world: $1"
  else
    result 1 "a world: $1"
    diag "status $status" "$(head -c 2000 "$scratch/err")"
  fi
}

refused 'writes no file' '2: .*call-with-output-file.*--trust' "(call-with-output-file \"$scratch/stolen\" write)"
refused 'starts no program' '2: .*system.*--trust' "(system \"touch $scratch/stolen\")"
refused 'reads no file' '2: .*open-input-file.*--trust' '(open-input-file "/etc/passwd")'
refused 'names no other file' '2: .*/etc/passwd' '(extend "/etc/passwd")'
refused 'opens no port' '2: .*socket.*--trust' '(socket 2 1 0)'
refused 'loads nothing' '2: .*load.*--trust' '(load "/etc/passwd")'
refused 'changes nothing in place' '2: .*set' '(set! car cdr)'
refused 'does not end this process' '2: .*exit.*--trust' '(exit 0)'
refused 'hands out no procedure' " \`sea' is given by a procedure.*--trust" \
  '(define-world p "P." (sea (current (lambda (p t) (vec 0 0 0)))))'
BIGHT_LESSON_SECONDS=$little
refused 'a loop without end' ' .*processor time.*--trust' '(let loop () (loop))'
refused 'much in many forms' ' .*processor time.*--trust' \
  "$(yes '(let loop ((n 0)) (if (< n 3000000) (loop (+ n 1))))' | head -n 3000)"
refused 'a list without end' ' .*\(memory\|overflow\|processor time\)' '(let loop ((l (list 1))) (loop (cons 1 l)))'
BIGHT_LESSON_SECONDS=$plenty
refused 'a string without end' '2: .*length' '(let loop ((s "abc")) (loop (string-append s s)))'
refused 'a recursion without end' ' .*\(memory\|overflow\)' '(let loop ((n 0)) (+ 1 (loop n)))'
refused 'a mistake has its line' "2: world: an rov has no .att" '(world (rov (att 1 2 3)))'
refused 'a form without end' '[0-9:]* .*end of input' '(world (rov'
[ ! -e "$scratch/stolen" ]
result $? 'and no world has written a file'

for endless in /dev/zero "$scratch/pipe"; do
  [ -e "$endless" ] || mkfifo "$endless"
  echo "(define-world w \"W.\" (sea (depth 9)) (seabed (grid \"$endless\")))" >"$scratch/world.scm"
  timeout "$patience" "$pre" bight -c "(enter! \"$scratch/world.scm\")" >"$scratch/out" 2>"$scratch/err" </dev/null
  [ $? -eq 1 ] && grep -q '^bight: enter!: .*file' "$scratch/err"
  result $? "a world has no sea bed from $(basename "$endless")"
done

# Whom the user trusts may do all that he may; so may what lies where worlds are looked for by name.
echo "(call-with-output-file \"$scratch/stolen\" write) (define-world w \"W.\" (sea (depth 9)))" >"$scratch/world.scm"
"$pre" bight snapshot "$scratch/world.scm" -o "$scratch/w.png" </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && [ ! -e "$scratch/w.png" ] && grep -q -e '--trust' "$scratch/err"
result $? 'a picture of a world from outside is not drawn when it does more than make a world'
"$pre" bight pilot "$scratch/world.scm" </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && [ ! -e "$scratch/stolen" ]
result $? 'nor is it flown'
"$pre" bight -c "(enter! \"$scratch/world.scm\" #:trust #t) (sea-depth)" </dev/null 2>"$scratch/err" | grep -qx 9.0 \
  && [ -e "$scratch/stolen" ]
result $? 'trusted, it may write'
rm -f "$scratch/stolen"
mkdir "$scratch/worlds"
mv "$scratch/world.scm" "$scratch/worlds"
(cd "$scratch" && "$pre" bight -c '(enter! "worlds/world.scm")' </dev/null >out 2>err) && [ -e "$scratch/stolen" ]
result $? 'so may one in a folder of worlds'
rm -f "$scratch/stolen"

# What a dive needs is there inside too: a convex body had wanted to write to a null device.
cat >"$scratch/convex.scm" <<'END'
(define-lesson yard-lesson "A yard"
  (in (world (sea (depth 20)) (convex (named rock) (points (0 0 -20) (4 0 -20) (0 4 -20) (4 4 -20) (2 2 -12)))
       (rov (named m) (at 1 8 -5)) (tether (named t) (wet-weight 0) (from 1 6 -2) (to m) (length 12))))
  (task "Wait." (done-when (> (now) 1)))
  (pilot expert "Waits." (flies (run 2))))
END
check 'a lesson from outside may have a convex body' \
  "$pre" bight lesson "$scratch/convex.scm" --pilot expert

# What the language does not stop, the kernel does.
cat >"$scratch/kernel.scm" <<END
(use-modules (bight core sandbox))
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

cat >"$scratch/reading.scm" <<END
(use-modules (bight core sandbox))
(display (enclose! #:reading (list "$scratch/state")))
(newline)
(force-output)
(for-each (lambda (file) (when (false-if-exception (call-with-input-file file read-char)) (display file)))
          '("/etc/passwd" "$scratch/pond.scm" "$scratch/state/own"))
END
mkdir -p "$scratch/state"
echo 1 >"$scratch/state/own"
how=$("$pre" bight "$scratch/reading.scm" 2>/dev/null </dev/null)
case $how in
  kernel*)
    [ "$how" = "kernel
$scratch/state/own" ]
    result $? 'nor does the process of a world read what is not its own' ;;
  *)
    skip 'nor does the process of a world read what is not its own: no Landlock here' ;;
esac

finish
