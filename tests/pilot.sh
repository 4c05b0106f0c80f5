# Fly in a terminal, by the keys of a tmux: what the screen shows, and how it is left.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

. "$top_srcdir/tests/tmux.sh"

fly ()
{
  keys "bight pilot pier $*" Enter
  see ' depth .* m '
}

the_pid ()
{
  pgrep -P "$(pane display-message -p '#{pane_pid}')" -x bight
}

# ---- A flight: figures, sticks, views, the prompt ----

begin 120 40 COLORTERM=truecolor
check 'a flight begins' fly
see ' out *35.00 m'
result $? 'and shows how much tether is out'
see 'depth *4.00 m'
result $? 'and how deep the vehicle is'

# A shell whose child is killed may read before the terminal is given back: a read without a byte would be
# the end of its input.
stty -F "$(pane display-message -p '#{pane_tty}')" -a | grep -q 'min = 1; time = 0;'
result $? 'a read of the terminal waits for a key'

keys W
see 'surge +0.1'
result $? 'a key with shift nudges a stick'
keys W W W W W
see ' in [0-9]* s '
result $? 'what is to come is foretold'
prod 'yaw +1.0' d d
result $? 'a key holds its stick'
see 'yaw  0.0'
result $? 'and lets it go'
keys Space
see 'surge  0.0'
result $? 'the space bar lets go of all'
keys 3
see ' top .*/s'
result $? 'views have numbers'
keys v
see ' side .*/s'
result $? 'v shows the next one'
keys '?'
see 'ahead, astern'
result $? 'there is help'
keys '?' ']'
see ' out *\(35.[1-9]\|36\)'
result $? 'the winch pays out'
prod 'holding heading' h
result $? 'an autopilot holds'
keys p
see PAUSED
result $? 'a dive is paused'
keys p g
see 'what if'
result $? 'a fork runs ahead'
keys Space
prod 'yaw +1.0' d d d d
see 'yaw  0.0'
prod 'back at' u && see 'yaw  0.0'
result $? 'time goes back, and no stick with it that nobody holds'

keys :
see 'bight>$'
result $? 'the prompt is one key away'
keys "(drive! #:heave 1)" Enter "(list 'steps (begin (let loop ((t (+ 1 (now)))) (when (< (now) t) (loop t))) 'by))" Enter
see 'steps by'
result $? 'the dive goes on meanwhile, without `run'\'
keys ,q Enter
see 'heave +1.0'
result $? 'and what was said there holds'

pane resize-window -x 250 -y 80
see '^.\{200\}'
result $? 'a larger window is filled'
pane resize-window -x 80 -y 24
see ' depth .* m '
result $? 'and a smaller one'
[ "$(screen | grep -c .)" -le 24 ]
result $? 'within its lines'
keys 1
see ' chase .*/s'
pane resize-window -x 10 -y 3
see '^ pier  *[0-9.]*$'
pane resize-window -x 80 -y 24
see ' chase .*/s'
result $? 'one too small for a picture costs none later'

keys q
check 'q leaves a terminal as it was' sane

# ---- A belief ----

begin 120 40 COLORTERM=truecolor
keys "bight pilot pile --belief '(current (error 0.1))' --tethers 8" Enter
see 'P(wound) 0.* of 8 tethers'
result $? 'what a belief holds is told'
keys x
see ':::*.'
result $? 'and its tubes stand in plain characters'
keys c
see 'the belief is not shown'
result $? 'until they are not wanted'
keys q
sane >/dev/null
begin 100 30 COLORTERM=
keys "bight pilot pile --belief '(current (eror 0.1))'" Enter
see 'eror'
result $? 'a belief that is none is refused, and nothing begins'

# ---- Other ways out ----

begin 80 24 COLORTERM= TERM=screen-256color
fly
keys C-c
check 'so does ^C, in 256 colours' sane

# leave_by SIGNAL: fly, be killed, look; once more if it was the tmux that died.
leave_by ()
{
  for turn in 1 2; do
    begin 100 30 COLORTERM=
    fly
    kill -"$1" "$(the_pid)"
    sane && return 0
    pane list-sessions >/dev/null 2>&1 && return 1
  done
  return 1
}
for how in TERM HUP 9; do
  check "so does kill -$how" leave_by $how
done
begin 100 30 COLORTERM=
fly
keys C-z
check 'so does ^Z, for a while' sane
keys fg Enter
see ' depth .* m '
result $? 'and the flight goes on'
keys q
sane >/dev/null

# ---- Lesser terminals ----

begin 90 30 NO_COLOR=1
fly
see 'from above'
result $? 'without colours the view is plain characters'
keys x
see ' chase .*/s'
result $? 'or light and dark ones'
keys q
sane >/dev/null
begin 80 24 BIGHT_GL=none
fly
see 'from above'
result $? 'so it is without a graphics library'
prod 'pictures are drawn by osmesa or egl' x
result $? 'and a line says why'
keys q
sane >/dev/null

begin 90 30 COLORTERM= TERM=screen-256color LC_ALL=C
keys "bight -c \"(begin (enter! 'pile) (show))\"" Enter
see 'plain characters, from above'
screen | LC_ALL=C grep -q '[^ -~]'
[ $? -ne 0 ]
result $? 'show writes ASCII alone where the locale has nothing else'

# ---- Keys that come up, and the mouse: the bytes of terminals that tell of them ----

# send TEXT: bytes, each \033 an escape.
send ()
{
  keys -l "$(printf "$1")"
}

begin 100 30 COLORTERM= TERM=screen-256color
fly
send '\033[?7u\033[119;1:1u\033[100;1:1u'
see 'surge +1.0.*yaw +1.0'
result $? 'where releases are told two keys hold their sticks at once'
moment 10
shows 'surge +1.0.*yaw +1.0'
result $? 'for longer than a key that says nothing'
send '\033[119;1:3u' && see 'surge  0.0.*yaw +1.0'
result $? 'what comes up lets go of its own'
send '\033[O' && see 'yaw  0.0'
result $? 'and all does with the focus'
prod 'the mouse turns the overview' -l "$(printf '\033[<0;10;10M')"
result $? 'the mouse says where it does something'
keys 5 && see ' overview '
screen >"$scratch/before"
send '\033[<0;10;10M\033[<32;30;12M\033[<0;30;12m' && see '+ N'
result $? 'it turns the overview, which shows its axes'
send '\033[<64;10;10M\033[<64;10;10M\033[<64;10;10M' && see '+ up'
result $? 'and comes nearer'
keys 5 && see ' overview '
keys q
check 'the mouse is given back' sane
[ "$(pane display-message -p '#{mouse_any_flag}')" = 0 ]
result $? 'to the terminal'

# ---- A controller: a recorded stream ----

cat >"$scratch/events" <<'EVENTS'
(bight-events 1)
(0 plugged 0 "Pad of a test" #t)
(0.5 axis 0 "righty" -0.56)
(1 button 0 "y" #t)
EVENTS
begin 100 30 COLORTERM= TERM=screen-256color
keys "bight pilot pier --controller $scratch/events" Enter
see ' pads 1 ' && see 'surge +0.5'
result $? 'a pad moves the sticks'
prod 'yaw +1.0' d d && see 'surge +0.5'
result $? 'and keys do beside it'
keys q
sane >/dev/null
echo '(2 lost 0)' >>"$scratch/events"
keys "clear; bight pilot pier --controller $scratch/events" Enter
see 'Pad of a test is lost: sticks centred, holding'
result $? 'one that is lost is missed'
see 'surge  0.0' && ! shows ' pads '
result $? 'and asks for nothing any more'
keys q
sane >/dev/null
cat >"$scratch/lesson.scm" <<'LESSON'
(define-lesson short "Short"
  (in open-water)
  (task "Move." (done-when (> (abs (x (rov-position))) 1000)) (at-most 6000))
  (score (rov-depth 0 100)))
LESSON
printf '(bight-events 1) (0 plugged 0 "Pad" #t) (1 button 0 "a" #t) (2 axis 0 "leftx" -1)' >"$scratch/events"
keys "clear; bight lesson $scratch/lesson.scm --trust --controller $scratch/events" Enter
see '^ e hint' && see 'yaw -1.0'
result $? 'a lesson is begun and flown by it'
keys q
sane >/dev/null
printf '(bight-events 1) (0 plugged 0 "Pad" #t) (1 button 0 "a" #t) (2 axis 0 "righty" -1) (5 lost 0)' >"$scratch/late"
keys "clear; bight lesson $scratch/lesson.scm --trust --fresh --controller $scratch/late" Enter
see 'surge +1.0' && keys : && see '^ bight> _' && keys -l '(rov-speed' && see 'Pad is lost: sticks centred' && see '^ bight> (rov-speed_'
result $? 'one that is lost while a line is typed is told beside it'
keys C-u Escape
see '^ e hint\|Pad is lost' && see 'surge  0.0' && keys : && see '^ bight> _' && keys -l '(run 4) (< (rov-speed) 0.1)' && keys Enter &&
  see '^ #t'
result $? 'and the vehicle holds its place'
keys q
sane >/dev/null
"$top_builddir/pre-inst-env" bight controller --stream "$scratch/events" --for 3 >"$scratch/out"
grep -q '^0 leftx -1.00   surge +0.00 sway +0.00 heave +0.00 yaw -1.00$' "$scratch/out"
result $? 'what each axis does is shown'
"$top_builddir/pre-inst-env" bight controller --for 0 | grep -q 'plugged in later; C-c ends'
result $? 'who has none is told what is waited for'

# ---- A recording ----

"$top_builddir/pre-inst-env" bight -c "(begin (enter! 'pile) (record! \"$scratch/a.rec\") (move! '(6 -4 -5) #:speed 1)
  (run 20) (stop-recording!))" >/dev/null
begin 100 30 COLORTERM= TERM=screen-256color
keys "bight watch $scratch/a.rec --ghost $scratch/a.rec" Enter
see '0:0[0-9] / 0:20'
result $? 'a recording is watched'
keys n
see 'arrived minnow' && see PAUSED
result $? 'from event to event'
keys t
see '^ tension, N' && keys t t t && see '^ depth, m'
result $? 'with a plot of what it does'
keys 0
see '0:00 / 0:20'
result $? 'from its beginning'
keys ']' Left
see '0:09 / 0:20'
result $? 'and scrubbed'
keys q
check 'and left as it was' sane

# ---- A stranger's world ----

printf '(define-world #{w\033]0;owned\007}# "W." (sea (depth 20))
  (rov (at 1 5 -5)) (tether (wet-weight 0) (from 1 0 -2) (length 12)))' >"$scratch/world.scm"
begin 90 30 COLORTERM=
title=$(pane display-message -p '#{pane_title}')
keys "bight pilot $scratch/world.scm" Enter
see ' depth .* m '
result $? 'a world from outside is flown'
[ "$(pane display-message -p '#{pane_title}')" = "$title" ]
result $? 'and its name does not name the window'
keys q
sane >/dev/null

# ---- No terminal ----

"$top_builddir/pre-inst-env" bight pilot pier </dev/null >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && [ "$(wc -l <"$scratch/err")" -eq 1 ] && grep -q 'terminal' "$scratch/err"
result $? 'without a terminal there is one clear line'

# ---- A terminal that goes away ----

begin 80 24 COLORTERM=
fly
pid=$(the_pid)
pane kill-server
await gone "$pid"
result $? 'a terminal that is closed ends the flight'
finish
