# The first lesson in a terminal, by the keys of a tmux, as somebody takes it who has read nothing but the
# README: what the screen says, a wrong key, leaving and going on, flying, marks, and how it is left.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/tmux.sh"

# Type a line.
line ()
{
  keys -l -- "$1"
  keys Enter
}

begin 100 40 "BIGHT_LOGBOOK='$scratch/logbook.db'" "XDG_STATE_HOME='$scratch/state'" BIGHT_TRAINEE=ann COLORTERM=
line 'bight lesson 1'
see '^You are the pilot of a small vehicle'
result $? 'the first lesson begins'
see '^(Enter goes on)' && screen | grep -q 'A anchor   ^ minnow   current none'
result $? 'its first picture can be looked at'
keys Enter
see 'current 0.25 m/s --> 090'
result $? 'then the second'
keys Enter
see '  a number>'
result $? 'it asks'
line 'west'
see 'a number, such as 45; q leaves'
result $? 'who answers wide of the question is told how'
line '211'
see 'it was 2[01].; asked within 25'
result $? 'an answer is judged'
see '  left, right>'
line q
check 'q leaves a terminal as it was' sane
line 'clear; bight lesson 1'
see '^Going on where you left' && see '  left, right>'
result $? 'and the lesson goes on at the same question'
line right
see 'Right: said right, it was right'
result $? 'a word is an answer too'
line '215'
see 'it was 21.; asked'
line '300'
see 'it was 30.; asked' && see '  left, right>$'
line left
see '(Enter goes on)'
keys Enter
see 'north-east, .* a number>\|  a number>$'
line '98'
see '(Enter begins)'
result $? 'after the last question there is a task'
keys Enter
see '^w s ahead  a d turn'
result $? 'the dive goes on, and the keys are shown'
keys p
see '^PAUSED'
result $? 'p stops time'
keys w w
see 'sticks +0.40'
result $? 'keys fly'
keys h
see '^Hint: Turn toward the bow'
result $? 'h gives a hint'
keys p
see '^[0-9.]* s   heading'
result $? 'and lets it go on'

# The line lies elsewhere when one comes: fly there again until it is done.
keys :
see '^scheme>'
line '(let on () (fly-to! (point-at (/ (tether-length) 2)) #:speed 0.8) (run 1) (on))'
see '^read-the-bow: [0-9]* out of 100'
result $? 'a line of Scheme flies too, and the marks come at the end'
screen | grep -q ', passed'
result $? 'it is passed'
check 'the terminal is as it was' sane
line 'clear; bight lessons'
see '^01  read-the-bow  *\(100\|[7-9][0-9]\)  Read the bow'
result $? 'and the marks are in the list'

finish
