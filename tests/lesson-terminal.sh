# The first lesson in terminals of several kinds, by the keys of a tmux, as somebody takes it who has read nothing but
# the README: what the screen says, a wrong key, leaving and going on, flying, marks, and how it is left.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/tmux.sh"

# Type a line.
line ()
{
  keys -l -- "$1"
  keys Enter
}

# answer LINE: type the answer to a probe, once it is asked.
answer ()
{
  see '^ \(a bearing, degrees\|left, right\)> _' && line "$1"
}

# take_seat COLUMNS ROWS SETTING...: a terminal, and the first lesson in it by somebody new.
seats=0
take_seat ()
{
  seats=$((seats + 1))
  columns_of_seat=$1
  rows_of_seat=$2
  shift 2
  begin "$columns_of_seat" "$rows_of_seat" "BIGHT_LOGBOOK='$scratch/logbook$seats.db'" \
    "XDG_STATE_HOME='$scratch/state$seats'" BIGHT_TRAINEE=ann "$@"
  line 'bight lesson 1'
  see 'You are the pilot of' && see '^ Enter goes on'
}

# The review: w opens the moment at which a mark was lost, standing still; q comes back; Enter goes on to the marks.
watch_what_was_lost ()
{
  see 'Marks were lost here' && keys w && see PAUSED && see '^ 0:[0-9][0-9] / 0:[0-9][0-9] ' && keys Left &&
    keys q && see 'Marks were lost here' && keys Enter
}

# The line lies elsewhere when a vehicle comes: fly there again until it is done.  What the marks ask for before they
# come is the argument.
fly_to_the_bow ()
{
  see '^ e hint' && keys : && see '^ bight> _' || return 1
  line '(let on () (fly-to! (point-at (/ (tether-length) 2)) #:speed 0.8) (run 1) (on))'
  see 'Done\.' && keys Enter && $1 && see '^read-the-bow: [0-9]* out of 100, passed'
}

# ---- All of it, in a large terminal with all colours ----

check 'the first lesson begins in the cockpit' take_seat 120 40 COLORTERM=truecolor LC_ALL=C.UTF-8
see '+ A' && see '+ minnow' && see 'N up |'
result $? 'its first picture has names and a map'
keys Enter
see 'bears 180 from you'
result $? 'then the second'
keys Enter
see '^ a bearing, degrees> _'
result $? 'it asks over the picture'
line 'west'
see 'a number, such as 45'
result $? 'who answers wide of the question is told how'
line '400'
see 'a bearing is from 0, north'
result $? 'and who answers out of range'
pane resize-window -x 10 -y 3
see '^ a .*_$'
pane resize-window -x 120 -y 40
see '^ a bearing, degrees> _'
result $? 'a window that was tiny for a while costs nothing'
printf '2\nq\nxy' >"$scratch/paste"
pane load-buffer "$scratch/paste"
pane paste-buffer -p
see '> 2 q xy_'
result $? 'what is pasted is one line'
keys C-u
keys -l 2199
keys BSpace BSpace Left BSpace End C-e
line '1'
see 'it was 2[01].; asked within 25'
result $? 'a line can be edited, and an answer is judged'
see '^ left, right> _'
keys C-c
check 'leaving gives the terminal back' sane
line 'clear; bight lesson 1'
see '^ left, right> _'
result $? 'and the lesson goes on at the same question'
line ri
see 'Right: said right, it was right' && see 'So it was'
result $? 'a word is answered by its beginning, and how it was is shown'
keys Enter
answer 215
see 'it was 21.; asked'
keys Enter
answer 300
see 'it was 30.; asked'
answer left
see 'So it was, with the anchor'
result $? 'what the lesson shows itself is shown once'
keys Enter
answer 98
see 'So it was'
keys Enter
see 'Last, use it'
keys Enter
see 'TASK: Fly to within a metre' && see '^ Enter begins'
result $? 'after the last question there is a task'
keys Enter
see '^ e hint' && see 'depth *8.00 m' && see '^ Fly to within a metre'
result $? 'it is flown in the cockpit, under its words'
keys C-z
sane
result $? '^Z gives the shell back'
line fg
see '^ e hint' && see 'depth *8.00 m'
result $? 'and the flight goes on'
keys p
see PAUSED
result $? 'p stops time'
keys W W
see 'surge +0.2'
result $? 'keys fly as in free flight'
keys e
see '^ Hint: Turn toward the bow' && see 'hints 1'
result $? 'e gives a hint, which is counted'
keys :
see '^ bight> _'
line '(list 1 (+ 1 1))'
see '^ (1 2)'
result $? 'what is typed at the prompt is answered in the panel'
keys :
see '^ bight> _'
line '(way-home)'
see '^ Home: '
result $? 'in the words in which the prompt answers'
keys '?'
see 'ahead, astern'
result $? 'there is help'
keys '?' p
check 'a line of Scheme flies too, and the marks come at the end' fly_to_the_bow watch_what_was_lost
check 'the terminal is as it was' sane
line 'clear; bight lessons'
see '^01  read-the-bow  *passed \(100\|[7-9][0-9]\)  *Read the bow: where is your tether?$'
result $? 'and the marks are in the list'

# ---- From start to mark in lesser ones ----

# take_all: the lesson from its first page to its marks.
take_all ()
{
  keys Enter
  see 'bears 180 from you' && keys Enter && answer 211 && answer right && see 'So it was' && keys Enter &&
    answer 215 && see 'it was 21.; asked' && keys Enter && answer 300 && answer right &&
    see 'So it was, with the anchor' && keys Enter && answer 98 && see 'So it was' && keys Enter &&
    see 'Last, use it' && keys Enter && see 'TASK' && keys Enter && fly_to_the_bow true
}

check 'it begins in 256 colours' take_seat 80 24 COLORTERM= TERM=screen-256color LC_ALL=C.UTF-8
keys q
sane >/dev/null
check 'it begins in sixteen colours' take_seat 80 24 COLORTERM= TERM=screen LC_ALL=C
screen | LC_ALL=C grep -q '[^ -~]'
[ $? -ne 0 ]
result $? 'in letters that are all ASCII where the locale has no others'
check 'and is taken to its marks' take_all
cat >"$scratch/ahead.scm" <<'LESSON'
(define-lesson ahead "Ahead"
  (in open-water)
  (task "Go ahead." (target "far" '(0 25 -8)) (done-when (> (range-to '(0 0 -5)) 1000)) (at-most 2))
  (task "Never." (done-when #f))
  (score (rov-depth 0 100))
  (pilot expert "Goes." (flies (drive! #:surge 1))))
LESSON
begin 80 24 COLORTERM= TERM=screen-256color LC_ALL=C.UTF-8
line "bight lesson $scratch/ahead.scm --trust"
see '^ Enter begins' && see '   1\( \|$\)'
result $? 'before a task its target is on the map already'
keys Enter
see 'a: begin the task again' && keys e && see 'Marks were lost here' && keys w &&
  see 'pale: the expert, from where you began' && see PAUSED && see ' expert ' && keys q && see 'Marks were lost here'
result $? 'beside what was flown the expert flies it'
keys Enter
sane >/dev/null
check 'it begins in a tiny window' take_seat 30 8 COLORTERM= TERM=screen LC_ALL=C
keys Enter
see 'do next'
result $? 'where a page goes on at the next'
keys q
check 'and which is left as it was' sane
finish
