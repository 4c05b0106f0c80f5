# An error names the line of the innermost form of the user's own that it is in: whatever the error, wherever
# the form stands, and whatever file it is in.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
BIGHT_LOGBOOK=$scratch/logbook.db
XDG_STATE_HOME=$scratch/state
export BIGHT_LOGBOOK XDG_STATE_HOME
cd "$scratch" || exit 99

# write_file FILE ERROR: standard input to FILE, with ERROR in place of BAD, the only word on its line but for
# what closes.
write_file ()
{
  cat >raw
  line=$(grep -n '^ *BAD' raw | cut -d: -f1)
  awk -v error="$2" '{ i = index($0, "BAD"); if (i) print substr($0, 1, i - 1) error substr($0, i + 3); else print }' raw >"$1"
}

# told NAME FILE OUTPUT...: the place FILE:line is told.
told ()
{
  told_name=$1
  told_place=$2:$line:
  shift 2
  grep -qF -- "$told_place" "$@"
  told_status=$?
  result $told_status "$told_name"
  [ $told_status -eq 0 ] || diag "wanted $told_place" "$(cat "$@" | head -5)"
}

# in_scripts ERROR: in forms of every kind.
in_scripts ()
{
  write_file at-top.scm "$1" <<'SCM'
(enter! 'pile)
(run 0.1)
BAD
SCM
  write_file in-a-procedure.scm "$1" <<'SCM'
(enter! 'pile)
(define (leg p)
  (list
    BAD
    p)
  (run 1))
(define (all)
  (for-each leg '(1)))

(all)
SCM
  write_file in-a-tail.scm "$1" <<'SCM'
(enter! 'pile)
(define (inner)
  (run 0.1)
  BAD)

(define (outer)
  (if (> (now) 100)
      1
      (inner)))
(outer)
SCM
  write_file in-a-loop.scm "$1" <<'SCM'
(enter! 'pile)
(define (go)
  (let loop ((i 0))
    (cond ((= i 3)
           BAD)
          (else (loop (+ i 1))))))
(let ((x (begin
           (go))))
  x)
SCM
  write_file in-an-argument.scm "$1" <<'SCM'
(enter! 'pile)
(define-syntax-rule (twice x) (begin x x))
(twice
 (run-until
  (lambda ()
    BAD)
  #:at-most 5))
SCM
  write_file after-a-callback.scm "$1" <<'SCM'
(enter! 'pile)
(for-each
 (lambda (i)
   (run 0.1))
 '(1 2))
(catch #t
  (lambda ()
    (run -1))
  (lambda (key . rest) #t))
(let ((a 1))
  BAD)
SCM
  write_file in-a-sum.scm "$1" <<'SCM'
(enter! 'pile)
(define (total x)
  (+ 1 (* 2 (abs (- x
                    3)))
     (length (list (list x)
                   BAD))))
(abs (total (abs -1)))
SCM
  for file in at-top in-a-procedure in-a-tail in-a-loop in-an-argument after-a-callback in-a-sum; do
    line=$(grep -nF -- "$1" $file.scm | cut -d: -f1)
    "$pre" bight $file.scm >out 2>err </dev/null
    told "$1 $file" $file.scm err
  done
}

in_scripts "(fly-to! '(1 2 3) #:sped 1)"
in_scripts '(car 5)'
in_scripts '(nobody-has-this 1)'
in_scripts '(error "so")'

# A wrong call of a verb that calls back is where it stands, not where it called back last.
write_file late.scm "(run-for-ever 'no)" <<'SCM'
(enter! 'pile)
(define (run-for-ever x)
  (car x))
(define (checks)
  (for-each (lambda (i) (vector-ref (vector 1) 0))
            '(1 2))
  BAD)
(checks)
SCM
line=3
"$pre" bight late.scm >out 2>err </dev/null
told 'a tail call of a procedure of the file' late.scm err

# ---- Other files ----

write_file one.scm '(run -1)' <<'SCM'
(define (helper)
  BAD)
(define-scenario s "S."
  (in pile)
  (run 1)
  (helper))
SCM
"$pre" bight test one.scm >out 2>&1 </dev/null
told 'a scenario' one.scm out

for error in '(run -1)' '(car 5)'; do
  write_file lesson.scm "$error" <<'SCM'
(define (helper)
  BAD)
(define-lesson l "L"
  (in open-water)
  (task "T"
    (done-when (begin (helper) #t)) (at-most 3))
  (pilot expert "E" (flies (run 1))))
SCM
  "$pre" bight lesson lesson.scm --pilot expert >out 2>err </dev/null
  told "a lesson from outside, in a condition: $error" lesson.scm err
  "$pre" bight lesson --trust lesson.scm --pilot expert >out 2>err </dev/null
  told "a lesson that is trusted: $error" lesson.scm err
  write_file lesson.scm "$error" <<'SCM'
(define-lesson l "L"
  (in open-water)
  (task "T" (done-when (> (now) 1)) (at-most 3))
  (pilot expert "E" (flies (run 1)))
  (pilot hasty "H"
    (flies
      BAD)))
SCM
  "$pre" bight lesson --check lesson.scm >out 2>err </dev/null
  told "a pilot who is checked: $error" lesson.scm out

  write_file world.scm "$error" <<'SCM'
(define (helper)
  BAD)
(define-world w "W."
  (sea (depth
         (helper))))
SCM
  "$pre" bight -c '(enter! "world.scm")' >out 2>err </dev/null
  told "a world from outside: $error" world.scm err
  "$pre" bight -c '(enter! "world.scm" #:trust #t)' >out 2>err </dev/null
  told "a world that is trusted: $error" world.scm err

  if "$pre" bight -c '(logbook)' >/dev/null 2>&1; then
    write_file study.scm "$error" <<'SCM'
(define (helper)
  BAD)
(define-study s "S." #:for ((push 1))
  (in tank)
  (fly (helper))
  (measure (t (now))))
SCM
    "$pre" bight sweep study.scm -o "study$line$tests.db" >out 2>err </dev/null
    told "a study: $error" study.scm err
  else
    skip "a study: $error: built without SQLite"
  fi
done

printf '(enter! (quote pile))\n(define (f)\n  (run -1))\n(f)\n' | "$pre" bight - >out 2>err
line=3
told 'standard input' stdin err

# Loops take no room: a million turns end in the memory of a few.
cat >loop.scm <<'SCM'
(define (count n)
  (if (> n 0)
      (count (- n 1))
      (begin (display "end") (newline))))
(define (ping n) (if (> n 0) (pong (- n 1)) (count 3)))
(define (pong n) (ping n))
(count 1000000)
(ping 1000000)
SCM
(ulimit -v 400000; "$pre" bight loop.scm >out 2>err </dev/null)
[ "$(grep -c end out)" -eq 2 ]
result $? 'loops take no room'
[ ! -s err ] || diag "$(cat err)"
# ---- The chain that led there ----

cat >legs.scm <<'SCM'
(define (leg surge)
  (list
    (drive! #:surge surge)))
(define (all)
  (+ 1
     (car (leg 3))))
SCM
cat >main.scm <<'SCM'
(enter! 'pile)
(load "legs.scm")
(define (go)
  (list (all)))
(display
  (go))
SCM
"$pre" bight main.scm >out 2>err
[ "$(cat err)" = "bight: legs.scm:3: drive!: #:surge must be a number from -1 to 1, not 3 \
(in leg, called from legs.scm:6 in all, called from main.scm:4 in go, called from main.scm:6)" ]
result $? 'a script tells the procedures and lines that led to an error, also in a file that it loads'
[ "$(wc -l <err)" -eq 1 ]
result $? 'in one line'

cat >chained.scm <<'SCM'
(define (leg surge)
  (list
    (drive! #:surge surge)))
(define-scenario chained
  "A leg that cannot be flown."
  (in pile)
  (leg 3))
SCM
"$pre" bight test chained.scm >out 2>err
grep -q '^#  *chained.scm:3 in leg: (drive! #:surge surge)))$' out && grep -q '^#  *chained.scm:7: (leg 3))$' out
result $? 'a test tells each with its source'

"$pre" bight -c '(/ 1 0)' >out 2>err
echo '(/ 1 0)' | "$pre" bight 2>>err
[ "$(grep -c '^bight: .*divide: a division by zero$' err)" = 2 ]
result $? 'a division by zero is called so'

cat >claimed.scm <<'SCM'
(define (half x)
  (let ((y (/ x 2)))
    (car y)))
(define-scenario claimed
  "A claim about what cannot be."
  (expect (+ 1 (half 4)) => 2)
  (expect (pay-out! 1) => 2))
SCM
"$pre" bight test claimed.scm >out 2>err
grep -q 'car: .* (at claimed.scm:3 in half, called from claimed.scm:6)$' out
result $? 'and a claim: the line in the procedure that it calls'
[ "$(grep -c ' (at ' out)" -eq 1 ]
result $? 'which an error in the claim itself needs not'

if "$pre" bight -c '(logbook)' >/dev/null 2>&1; then
  cat >claimed-study.scm <<'SCM'
(define (half x)
  (let ((y (/ x 2)))
    (car y)))
(define-study s "S." #:for ((push 1))
  (in tank)
  (fly (list (half push)))
  (measure (t (now))))
SCM
  "$pre" bight sweep claimed-study.scm -o claimed.db >out 2>err </dev/null
  grep -q 'claimed-study.scm:3: car: .* (in half, called from claimed-study.scm:6)$' err
  result $? 'and a case of a study'
else
  skip 'and a case of a study: built without SQLite'
fi

finish
