# Scenarios run again and again in a terminal, and one key from a failure to its flight in the cockpit.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

. "$top_srcdir/tests/tmux.sh"

XDG_STATE_HOME=$scratch/state
export XDG_STATE_HOME
mkdir "$scratch/tests"
cat >"$scratch/tests/odd.scm" <<'END'
(define-scenario fails-first "Its slack is small." (in pile) (run 3) (expect (slack) is (above 1000)))
(define-scenario fails-too "So it is here." (in pile) (run 5) (expect (slack) is (above 1000)))
(define-scenario passes "This passes." (in pile) (run 1) (expect (now) => 1.0))
END

begin 80 24
keys "bight test --watch $scratch/tests -j 1" Enter
see 'w shows how fails-first failed'
result $? 'what failed can be shown'
keys w
see 'pile  3.0 s.*PAUSED'
result $? 'w shows the flight, standing still where it failed'
keys Left
see 'pile  2.0 s'
result $? 'and it can be wound back'
keys q
see 'w shows how fails-too failed'
result $? 'q comes back, to the next that failed'
keys w
see 'pile  5.0 s.*PAUSED'
result $? 'which w shows'
keys q
see 'w shows how fails-first failed'
result $? 'and then the first again'
echo '(define-scenario fails-first "It is mended." (in pile) (expect (now) => 0.0))' >"$scratch/tests/odd.scm"
see '^# 1 passed, 0 failed'
result $? 'meanwhile what changes is run again'
keys C-c
check 'the terminal is as a shell wants it' sane
finish
