# The prompt, as a person at a terminal meets it: what it says of slips and of what happens, and what Tab gives.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/tmux.sh"

# prompts N: the screen shows N prompts or more.
prompts ()
{
  [ "$(screen | grep -c '^bight>')" -ge "$1" ]
}

# typed LINE: type LINE at the prompt, and wait for the next prompt.
typed ()
{
  typed_before=$(screen | grep -c '^bight>')
  keys -l -- "$1"
  keys Enter
  await prompts $((typed_before + 1))
}

# told NAME PATTERN COUNT: the screen has so many lines with PATTERN.
told ()
{
  told_found=$(screen | grep -c -- "$2")
  [ "$told_found" -eq "$3" ]
  result $? "$1"
  [ "$told_found" -eq "$3" ] || diag "$told_found lines with: $2" "$(screen | grep -v '^$' | tail -30)"
}

# at_prompt SETTING...: a prompt in a terminal of its own.
at_prompt ()
{
  begin 100 190 XDG_STATE_HOME="$scratch/state" "$@"
  keys 'clear; bight' Enter
  await prompts 1
}

# ---- Slips ----

at_prompt
result $? 'there is a prompt'
typed 'enter! pile'
told 'a name without its quote' "pile is a world: did you mean 'pile?" 1
typed ',hlep'
told 'a command after a comma' 'There is no command ,hlep; did you mean ,help?' 1
typed ',time (+ 1 1)'
told 'a command that is known is done' 'real time' 1
typed "(sample! 'tension)"
told 'a macro says how it is used' 'sample!: it is used as (sample! ' 1

# ---- Help ----

typed '(help "tangle")'
told 'help searches what names say of themselves' '^  fouled?  *Return' 1
typed ',apropos ^haul-p'
told ',apropos has a sentence' '^  haul-prospect  *Return' 1
typed "(describe 'sea)"
told 'a sea is described without a dive' '^  waves  .*jonswap' 1

# ---- What happens is told, once ----

typed "(enter! 'open-water)"
typed "(define (go) (place! (vec+ (rov-position) '(0 0 -1)) #:fresh #t) (move! (vec+ (rov-position) '(0 0 1))))"
typed '(begin (go) (run 5))'
told 'run tells what happens' '^ *[0-9.]* s  [a-z]* arrived$' 1
typed '(begin (go) (run-until arrived? #:at-most 5))'
told 'run-until tells it alike' '^ *[0-9.]* s  [a-z]* arrived$' 2
typed '(begin (go) (settle! #:at-most 5))'
told 'settle! too' '^ *[0-9.]* s  [a-z]* arrived$' 3
typed '(what-if (go) (run 5) (run 1) (run-until (lambda () #f) #:at-most 1))'
told 'what a fork does is told as such' '^ *[0-9.]* s  what if: [a-z]* arrived$' 1
typed '(run 3)'
told 'and not as if it had happened' '^ *[0-9.]* s  [a-z]* arrived$' 3
typed '(begin (go) (home-trial) (run 5))'
told 'a trial of a verb tells nothing' 'what if: ' 1

# ---- Tab knows where it is ----

# tab LINE PATTERN: type LINE and Tab, and wait until the screen shows PATTERN.
tab ()
{
  keys C-e C-u
  keys C-l
  keys -l -- "$1"
  keys Tab
  see "$2"
}

# listed_before FIRST SECOND: the screen has a row with FIRST above the first with SECOND.
listed_before ()
{
  screen | awk -v a="$1" -v b="$2" '$1 == a { seen = 1 } $1 == b { exit !seen } END { exit !seen }'
}

at_prompt
typed "(enter! (extend 'pile (sphere (named far) (at 40 0 -5) (radius 1)) (sphere (named by) (at 0 -9 -4) (radius 1))))"
tab "(winding '" ' far  *a sphere'
result $? 'after (winding there are obstacles, with what they are'
listed_before by far && listed_before p1 far
result $? 'the nearest first'
tab "(enter! '" ' pile  *One pile in a gentle current'
result $? 'worlds come with their sentences'
tab '(drive! #:' '#:yaw  *a number from -1 to 1'
result $? 'keywords of this verb, with what they take'
screen | grep -q '#:fresh'
[ $? -ne 0 ]
result $? 'and no other'
tab '(pay-out! 3 #:' "(pay-out! .* #:rate"
result $? 'a single choice is put in'
tab "(world (tether (leng" '(world (tether (length'
result $? 'fields of a part'
tab "(world (tether (model " ' catenary-simplex$'
result $? 'words of a field'
tab '(run ' '^(run SECONDS)$'
result $? 'where nothing can be completed, how the verb is called'
tab '(pay-out! 3 #:' '^RATE: m/s; a number above 0'
result $? 'while an argument is typed, its unit and default stand below'
tab "(clearance 'p1) (accuracy! " '^METRES: m; '
screen | grep -q '^RATE: '
[ $? -ne 0 ]
result $? 'and nothing of the argument before'
keys C-e C-u
keys -l '(define (double x)'
keys Enter
typed '(* 2 x))'
typed '(double 21)'
told 'a form of several lines is indented' '^[.]* *   (\* 2 x))$' 1
told 'and read' '= 42$' 1
keys C-r
keys -l 'double 2'
see 'reverse-i-search.*(double 21)'
result $? 'the history is searched'
keys C-a
keys C-k

# ---- A form of several lines, in colours ----

# coloured NAME PATTERN: the screen shows PATTERN, ESC standing for the escape character.
coloured ()
{
  await coloured_now "$2"
  result $? "$1"
}

coloured_now ()
{
  pane capture-pane -p -e | sed "s/$(printf '\033')/ESC/g" | grep -q -- "$1"
}

at_prompt TERM=xterm-256color
keys -l "(define (twice y) ; 'so"
see "; 'so"
coloured 'a macro and a comment' '(ESC\[1mdefineESC.*ESC\[90m; .so'
keys Enter
keys -l '(* 3 y))'
see '(\* 3 y))'
coloured 'parentheses that match' 'ESC\[1;7m(ESC.*twice'
keys Up
keys Home
keys C-k
keys -l '(define (twice x)'
keys Down
keys End
keys BSpace BSpace BSpace BSpace BSpace
keys -l '2 x))'
keys Enter
await prompts 2
typed '(twice 21)'
told 'earlier lines of a form are edited before it is read' '= 42$' 1
keys -l "(list 'one"
keys Enter
see '^\.\.\.\.\.\. '
keys C-c
await prompts 4
result $? '^C gives a form up'
typed '(+ 20 3)'
told 'and the next is read' '= 23$' 1
keys -l '(begin (display "long: ") (display "0123456789012345678901234567890123456789012345678901234567890123456789"))'
keys Enter
await prompts 6
told 'a line longer than the screen is read' '^long: 0123456789' 1
keys -l ',q'
keys Enter
see 'shell>$'
at_prompt TERM=xterm-256color NO_COLOR=1
keys Up Up Up Up Up
see '^\.\.\.\.\.\. *(\* 2 x))'
result $? 'the history has whole forms'
pane capture-pane -p -e | grep -q '[39][0-7]m'
[ $? -ne 0 ]
result $? 'no colours where none are wanted'
keys C-c

# ---- Values look like what they mean ----

at_prompt
typed "(enter! 'pile)"
typed '(sqrt 2)'
told 'a number is rounded' '^\$2 = 1.414$' 1
typed '(write $2)'
told 'its value keeps its digits' '^1.4142135623730951' 1
typed '(list $2 $2)'
told 'a value has a name' '^\$[0-9]* = (1.414 1.414)$' 1
typed '(tether-points 3)'
told 'a polyline is a table' '^ *x  *y  *z$' 1
typed '(define s (sample! 1 (slack)))'
typed '(run 3)'
typed 's'
told 'so is a series in time' '^ *time, s  *(slack)$' 1
typed '(worlds)'
told 'worlds come with their sentences' '^  pile  *One pile in a gentle current' 1
typed '(lessons)'
told 'lessons with their titles' '^  one-pile  *One pile, out and back' 1
typed '(status)'
told 'a panel is as it was' '^minnow    at (6.00 -6.00 -5.00)' 1

# ---- The chain that led to an error ----

cat >"$scratch/leg.scm" <<'SCM'
(define (leg surge)
  (list
   (drive! #:surge surge)))
(define (all)
  (+ 1
     (car (leg 3))))
SCM
at_prompt
typed "(enter! 'open-water)"
typed "(load \"$scratch/leg.scm\")"
typed '(list (all))'
told 'an error is told with the line that failed' 'leg.scm:3 in leg: (drive! #:surge surge)))$' 1
told 'and with the line that led there' 'leg.scm:6 in all: (car (leg 3))' 1
typed ',bt'
told 'and ,bt shows these lines again' 'leg.scm:6 in all: (car (leg 3))' 2
keys -l '(define (half x)'
keys Enter
keys -l '(let ((y (/ x 2)))'
keys Enter
typed '(car y)))'
typed '(list 1 (half 4))'
told 'a procedure that was typed is told by its line' '^  prompt.[0-9]*.:3 in half: (car y)))$' 1
typed ',bt'
told 'which ,bt shows, too' ' in half: (car y)))$' 2
typed '(drve! #:surge 3)'
told 'a slip in what was typed just now needs no place' 'did you mean .drive!' 1
told 'and has none' '^  prompt' 4
typed '(free-to-haul?)'
told 'an answer that was asked for is said in words' '^\$[0-9]* = #t: Yes: ' 1

# ---- A terminal that cannot do any of this ----

at_prompt TERM=dumb
typed '(+ 20 3)'
told 'a dumb terminal has a prompt' '= 23$' 1

finish
