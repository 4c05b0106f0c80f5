# An instructor and his pupil: what a script hands in, what a station shows, who may connect, and that a lesson left
# with an instructor's doings in it goes on with them.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/tmux.sh"

pre=$top_builddir/pre-inst-env
door=$scratch/door
cat >"$scratch/short.scm" <<'LESSON'
(define-lesson short "Short"
  (in (world (sea (depth 60)) (rov (named minnow) (at 0 0 -5)) (sphere (named log) (radius 0.5) (track (0 0 90 -5)))
             (tether (named line) (type fathom) (from 0 -20 -1) (to minnow) (length 30))))
  (task "Wait for the word." (done-when (positive? (counter 'go))) (at-most 6000))
  (score (rov-depth 0 100)))
LESSON

# hand LINE...: orders from a script; what comes of them.
hand ()
{
  printf '%s\n' "$@" | "$pre" bight instruct "$door" 2>&1
}

# at PANE: whose screen and keys these are from now on, 0 the pupil's, 1 the instructor's.
at ()
{
  pane select-pane -t "$1"
}

take_lesson ()
{
  keys "clear; bight lesson $scratch/short.scm --trust --instructor $door" Enter
}

begin 150 30 TERM=screen-256color LC_ALL=C.UTF-8 "BIGHT_LOGBOOK='$scratch/logbook.db'" "XDG_STATE_HOME='$scratch/state'"
hand '(words "nobody")' | grep -q 'no pupil listens'
result $? 'without a pupil an instructor is told so'
take_lesson
see '^ Enter begins' && hand '(words "Read well.")' | grep -q '^waiting$'
result $? 'an order waits for a pupil who reads'
keys Enter
see '^ e hint' && see 'Instructor: Read well'
result $? 'a pupil lets an instructor in'
hand '(see)' | grep -q 'late: words Read well.: done'
result $? 'who is told what came of an order for which he did not wait'
[ "$(stat -c %a "$door")" = 600 ]
result $? 'at a socket that is his own alone'
hand '(words "Look behind you.")' | grep -q '^done$' && see 'Instructor: Look behind you'
result $? 'words of a script are read by the pupil'
hand '(current 0.4 90)' '(form "(current-at (quote (0 0 -5)))")' | grep -q '#f64(0.4'
result $? 'it changes the current, and asks'
hand '(wait 0.1)' '(see)' | grep -q 'Wait for the word'
result $? 'and sees the task'
hand '(drift lug 0.5 180)' | grep -q 'no part .lug.*did you mean .log'
result $? 'what is not there cannot be set adrift'
hand '(form "(define (away) (rov-clearance (quote log)))")' '(drift log 2 180)' \
  '(form "(let ((was (away))) (run 2) (- was (away)))")' >"$scratch/nearer"
grep -q '^3[.]99\|^4[.]0' "$scratch/nearer"
result $? 'what waits is set adrift, and comes nearer'
hand '(current 0.4)' | grep -q 'an order is (words TEXT)'
result $? 'what is no order is refused, and told what would be one'
hand '(fault nothing)' | grep -q 'no vehicle .nothing'
result $? 'and what is not there to be broken'

pane split-window -h "exec env PS1='station> ' TERM=screen-256color LC_ALL=C.UTF-8 '$pre' sh"
at 1
keys "bight instruct $door" Enter
see 'overview' && see 'Wait for the word' && see 'depth  *[0-9.]* m'
result $? 'a station shows the dive and what the pupil reads'
keys w && keys -l 'well flown' && keys Enter && at 0 && see 'Instructor: well flown'
result $? 'words are typed there'
at 1
keys l && at 0 && see 'NO LIGHT'
result $? 'l takes the light'
at 1
keys b && keys -l 'compass 3' && keys Enter && see '^ done'
result $? 'b breaks something'
keys t && at 0 && see 'stopped the clock'
result $? 't stops the clock'
hand '(form "(list (faults) (now))")' | sed 's/.*((compass)/((compass)/' >"$scratch/before"
grep -q '^((compass) [0-9.]*)$' "$scratch/before"
result $? 'what is broken is broken'
keys q && see 'shell>$' && at 1 && see 'the pupil has left'
result $? 'a pupil who leaves is missed'
at 0
take_lesson
see '^ Enter begins' && keys Enter && see 'NO LIGHT' && see 'stopped the clock'
result $? 'who goes on has no light and no time either'
hand '(form "(list (faults) (now))")' | sed 's/.*((compass)/((compass)/' | cmp -s - "$scratch/before"
result $? 'and is where he was, with what was broken'
hand '(clock #t)' "(form \"(count! 'go)\")" >/dev/null
see 'Done\.' && keys Enter && see 'the instructor: well flown' && see 'the instructor: fault compass 3' &&
  see 'the instructor: drift log 2 180' &&
  see 'the instructor: light off'
result $? 'the marks say what the instructor did'
[ ! -e "$door" ]
result $? 'and the socket is gone'

keys "clear; bight pilot open-water --instructor $door" Enter
see '^ w s a d'
hand '(words "free")' '(light #f)' | grep -q done && see 'Instructor: free' && see 'NO LIGHT'
result $? 'a pilot in free flight has an instructor too'
hand '(clock #f)' >/dev/null && see PAUSED && keys q && see 'shell>$'
result $? 'who stops his time'
finish
