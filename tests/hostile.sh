# Text from anybody's file may hold what a terminal obeys: whatever the source and whatever the output, it is
# shown escaped.  And what comes from outside reads nothing that is not its own.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
BIGHT_LOGBOOK=$scratch/logbook.db
XDG_STATE_HOME=$scratch/state
export BIGHT_LOGBOOK XDG_STATE_HOME
cd "$scratch" || exit 99

# A window's title, the clipboard, the cursor, delete, the same by C1, a line read backwards.
evil=$(printf 'E\033]0;owned\007\033]52;c;b3duZWQ=\007\033[2J\033[1;1H\177\302\233\302\2352J\342\200\256E')
obeyed=$(printf '[\001-\010\013-\014\016-\037\177]|\302[\200-\237]|\342\200[\216\217\250-\256]|\342\201[\246-\251]')

# safe NAME FILE...: nothing in the files that a terminal obeys, and yet what was sent is there.
safe ()
{
  safe_name=$1
  shift
  if LC_ALL=C grep -aqE "$obeyed" "$@"; then
    result 1 "$safe_name"
    diag "$(LC_ALL=C grep -ahE "$obeyed" "$@" | head -3 | od -c | head -12)"
  elif ! grep -qF '\x1b' "$@"; then
    result 1 "$safe_name: it never came there"
    diag "$(cat "$@" | head -5)"
  else
    result 0 "$safe_name"
  fi
}

# out NAME ARGUMENT...: what bight ARGUMENTS print is safe.
out ()
{
  out_name=$1
  shift
  "$pre" bight "$@" >out 2>err </dev/null
  safe "$out_name" out err
}

# ---- Worlds ----

cat >world.scm <<END
(define-world #{w$evil}# "A world $evil."
  (sea (depth 20)) (seabed)
  (cylinder (named #{pile$evil}#) (from 0 0 -20) (to 0 0 1) (radius 0.5))
  (rov (named #{rov$evil}#) (at 1 5 -5))
  (tether (named #{line$evil}#) (wet-weight 0) (from 1 0 -2) (to #{rov$evil}#) (length 12)))
END
for verb in '(look)' '(status)' '(describe)' '(parts)' '(events)' '(world-documentation (find-world "world.scm"))'; do
  out "a world: $verb displays it" -c "(enter! \"world.scm\") (run 1) (display (list (world-name (find-world \"world.scm\")) $verb))"
done
out 'a world: a name that is near' -c '(enter! "world.scm") (part-at (quote pile))'
out 'a world: its picture cannot be written' snapshot world.scm -o "/nowhere/$evil.png"
printf '(define-world w "W." (sea (depth 9)))\n(error "no %s")\n' "$evil" >wrong.scm
out 'a world: its error' -c '(enter! "wrong.scm")'
out 'a world: its error, trusted' -c '(enter! "wrong.scm" #:trust #t)'
printf '(define-world w "W." (sea (depht%s 9)))\n' '\x1b;' | sed "s/depht.*9/#{depht$(printf '\033')}# 9/" >wrong.scm
out 'a world: a misspelt word' -c '(enter! "wrong.scm")'

# ---- Lessons ----

cat >lesson.scm <<END
(define-lesson outside "From outside $evil"
  (in (world (sea (depth 20)) (rov (named #{r$evil}#) (at 0 5 -5)) (tether (wet-weight 0) (from 0 0 -2) (to #{r$evil}#) (length 12))))
  (say "Say $evil")
  (show)
  (probe "Which $evil?" '#{a$evil}# #:choices (#{a$evil}# b))
  (task "Task $evil" (done-when (> (now) 3)) (hint-after 1 "Hint $evil") (fail-when #f "Failed $evil") (at-most 10))
  (pilot expert "Waits $evil." (answers (truth choices) truth) (flies (run 4)))
  (pilot careless "Errs $evil." (answers (truth choices) 'b) (flies (error "no $evil"))))
END
out 'a lesson: flown by its pilot' lesson lesson.scm --pilot expert
out 'a lesson: an error in it' lesson lesson.scm --pilot careless
out 'a lesson: checked' lesson --check lesson.scm
out 'a lesson: trusted' lesson lesson.scm --trust --pilot expert
printf '%s\n' 'b' h l s '(error "x")' '(run 4)' | "$pre" bight lesson lesson.scm --trainee "$evil" >out 2>err
safe 'a lesson: taken' out err
mkdir lessons
cp lesson.scm "lessons/01-e$evil.scm"
"$pre" env BIGHT_LESSONS="$scratch/lessons" bight lessons >out 2>err </dev/null
safe 'a lesson: listed' out err
out 'a pupil: listed' lessons --trainee "$evil" --csv
out 'a file that is not there' "no$evil.scm"

# ---- Scripts, scenarios, studies, recordings ----

printf '(error "no %s")\n' "$evil" >script.scm
out 'a script: its error' script.scm
out 'a name of a file' "./$evil.scm"
cat >scenario.scm <<END
(define-scenario (#{s$evil}# v) "Sentence $evil" #:for ((v "value $evil"))
  (in "world.scm") (display "said $evil") (expect (string-append "a" v) => "one
ok 99 - forged"))
END
out 'a scenario' test scenario.scm --junit report.xml
safe 'a scenario: JUnit' report.xml
! grep -q '^ok 99' out
result $? 'a scenario: no line of it is a result'
out 'a scenario: listed' test scenario.scm --list
"$pre" bight -c '(enter! "world.scm") (record! "r.rec") (run 1) (stop-recording!)' >/dev/null 2>&1
out 'a recording' -c '(display (replay "r.rec" #:enter #t)) (display (parts))'
printf 'garbage %s\n' "$evil" >"bad$evil.rec"
out 'what is no recording' replay "bad$evil.rec"
if "$pre" bight -c '(logbook)' >/dev/null 2>&1; then
  cat >study.scm <<END
(define-study #{s$evil}# "Study $evil."
  #:for ((#{v$evil}# '#{x$evil}# '#{y$evil}#))
  (in tank) (fly (when (eq? #{v$evil}# '#{y$evil}#) (error "no $evil")) (run 0.1)) (measure (#{m$evil}# #{v$evil}#)))
END
  out 'a study' sweep study.scm -o study.db
  out 'a study: its table' sweep --table study.db
  out 'a study: its rows' sweep --rows study.db
else
  skip 'a study: built without SQLite'
fi

# ---- A file that a world names ----

# unread NAME FILE PART: neither a lesson nor a world from outside learns what is in FILE.
secret=$scratch/elsewhere/secret
mkdir elsewhere own
printf 'topsecret 1 2 3\nncols secretly\n' >"$secret"
cp "$secret" "$secret.obj"
printf 'ncols 2\nnrows 2\nxllcorner -50\nyllcorner -50\ncellsize 100\n-20 -20\n-20 -20\n' >"$secret.asc"
ln -s "$secret.asc" own/link.asc
unread ()
{
  printf '(define-world w "W." (sea (depth 30) %s) %s (rov (at 0 0 -5)) (tether (from 0 0 -2) (length 12)))\n' "$2" "$3" >own/world.scm
  "$pre" bight -c '(enter! "own/world.scm") (display "entered")' >out 2>err </dev/null
  [ $? -eq 1 ] && ! grep -q 'topsecret\|secretly\|entered' out err
  result $? "a world from outside does not read $1"
  [ -s err ] || diag "$(cat out)"
  printf '(define-lesson l "L" (in (world (sea (depth 30) %s) %s (rov (at 0 0 -5)) (tether (from 0 0 -2) (length 12))))
  (task "Wait." (done-when (> (now) 1)) (at-most 9)) (pilot expert "Waits."))\n' "$2" "$3" >own/lesson.scm
  "$pre" bight lesson own/lesson.scm --pilot expert >out 2>err </dev/null
  [ $? -eq 1 ] && ! grep -q 'topsecret\|secretly\|passed' out err
  result $? "nor does a lesson read $1"
  [ -s err ] || diag "$(cat out)"
}
for name in "$secret" ../elsewhere/secret "$secret.asc" link.asc /etc/passwd /proc/self/environ; do
  unread "a grid at ${name#$scratch/}" '' "(seabed (grid \"$name\"))"
done
unread 'a mesh elsewhere' '' "(mesh (named m) (file \"$secret.obj\") (at 0 0 -9))"
unread 'a current elsewhere' "(current (grid \"$secret\"))" ''
for verb in include load include-from-path open-input-file call-with-input-file follow! read-track load-dive replay \
            find-world export-csv export-npz export-vtk export-gltf; do
  printf '(define-world w "W." (sea (depth 9)))\n(%s "%s")\n' "$verb" "$secret" >own/world.scm
  "$pre" bight -c '(enter! "own/world.scm") (display "entered")' >out 2>err </dev/null
  [ $? -eq 1 ] && ! grep -q 'topsecret\|secretly\|entered' out err
  result $? "a world from outside reads nothing by $verb"
done
"$pre" bight -c "(enter! (world (sea (depth 30)) (seabed (grid \"$secret\"))))" >out 2>err </dev/null
[ $? -eq 1 ] && ! grep -q 'topsecret' err
result $? 'what is no grid is not quoted to anybody'
cp "$secret.asc" own/bottom.asc
printf '(define-world w "W." (sea (depth 30)) (seabed (grid "bottom.asc")) (rov (at 0 0 -5)) (tether (from 0 0 -2) (length 12)))\n' >own/world.scm
"$pre" bight -c '(enter! "own/world.scm") (display "entered")' 2>err | grep -q entered
result $? 'what lies beside a world is read'
finish
