# A followed dive in a terminal: what comes, alarms, keys, and how it is left.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

. "$top_srcdir/tests/tmux.sh"

# A vehicle that swims to the end of its line, 25 m, from 15 m.
awk 'BEGIN { print "t,x,y,z,tension"
  for (i = 0; i <= 600; i++) printf "%.1f,0,%.2f,-8,17\n", i / 10, 15 + i * 0.05 }' >"$scratch/dive.csv"

begin 120 40 COLORTERM=truecolor
keys "bight follow $scratch/dive.csv --pace 8 --record $scratch/dive.bight" Enter
see 'dive.csv: [0-9]* readings from [0-9]* lines'
result $? 'the cockpit tells what comes'
see 'measured: tension 17.00 N'
result $? 'and what was measured'
see ' depth *8.00 m'
result $? 'the display is there'
see 'AHEAD: in .* the tether is taut'
result $? 'what will happen is told'
see 'COACH: You are at the end of your tether'
result $? 'the coach speaks'
see ' m from where it says it is'
result $? 'and how far the dive is from the vehicle'
keys '?'
see '  space p  pause, go on'
result $? 'its keys are told'
! shows astern
result $? 'and none that it has not'
keys '?'
keys 3
see ' top .*/s'
result $? 'views have their keys'
see 'the telemetry has ended'
result $? 'the end is told'
keys q
await given_back
result $? 'q leaves, and the terminal is given back'
see '^state [0-9a-f]*'
result $? 'what it came to stays on the terminal'
check 'the terminal is as a shell wants it' sane
check 'the recording replays' "$top_builddir/pre-inst-env" bight replay "$scratch/dive.bight"
finish
