# Lines on a socket: a form in, a datum out; errors as data, events at a rate; and the client for Python.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/socket.sh"

# talk SOCKET N <LINES: send all LINES, and print the N lines that come.
cat >"$scratch/talk.scm" <<'SCM'
(use-modules (ice-9 rdelim) (ice-9 binary-ports))
(define arguments (cdr (program-arguments)))
(define s (socket PF_UNIX SOCK_STREAM 0))
(connect s AF_UNIX (list-ref arguments 0))
(let ((bytes (get-bytevector-all (current-input-port))))
  (unless (eof-object? bytes) (put-bytevector s bytes)))
(force-output s)
(set-port-encoding! s "UTF-8")
(set-port-encoding! (current-output-port) "UTF-8")
(define the-end (read-char (open-input-string "")))
(let loop ((n (string->number (list-ref arguments 1))))
  (unless (zero? n)
    (let ((line (or (false-if-exception (read-line s)) the-end))) ; it may be cut off
      (unless (eof-object? line)
        (display line)
        (newline)
        (force-output)
        (loop (- n 1))))))
SCM
talk ()
{
  "$pre" "$GUILE" -s "$scratch/talk.scm" "$@"
}

begin_house --door

# ---- A datum in, a datum out ----

# answers NAME FORM ANSWER: the one line that comes.
answers ()
{
  printf '%s\n' "$2" | talk "$socket" 1 >"$scratch/out"
  [ "$(cat "$scratch/out")" = "$3" ]
  answered=$?
  result $answered "$1"
  [ $answered -eq 0 ] || diag "$2 was answered by $(cat "$scratch/out"), not $3"
}
answers 'a number' '(+ 1 2)' '(ok 3)'
answers 'a number that is none' '(list (/ 0. 0.) (/ 1. 0.) 1/3)' '(ok (+nan.0 +inf.0 1/3))'
answers 'nothing worth telling' '(if #f #f)' '(ok)'
answers 'true and false' '(list #t #f)' '(ok (#t #f))'
answers 'a vector is a list' "(list #(1 2) #f64(0.5) #2((1 2) (3 4)) #vu8(1))" '(ok ((1 2) (0.5) ((1 2) (3 4)) (1)))'
answers 'a pair is one too' "'((a . 1) (b . c) (d e . f))" '(ok ((a 1) (b c) (d e f)))'
answers 'a string with all that may be in one' '"a\nb\"\\é\x1b;"' '(ok "a\nb\"\\é\x1b;")'
answers 'a symbol with blanks is a string' "(list 'plain (string->symbol \"a b\") #:key)" '(ok (plain "a b" key))'
printf '(current-module)\n' | talk "$socket" 1 | grep -q '^(ok (object "#<directory (guile-user) .*>"))$'
result $? 'what has no written form'
answers 'an error of bight' '(drive! #:surge 2)' "(error domain \"drive!: #:surge must be a number from -1 to 1, not 2\")"
grep -q '^(error domain "drive!: ' "$scratch/out"
result $? 'with its kind'
printf '(car 1)\n' | talk "$socket" 1 | grep -q '^(error wrong-type-arg "car: .*")$'
result $? 'an error of Guile'
answers 'an unknown name' '(surge)' \
  '(error unbound-variable "Unbound variable: surge; did you mean #:surge, as in (drive! #:surge ...)?")'
printf "(throw 'my-key 1)\n" | talk "$socket" 1 | grep -q '^(error my-key ".*")$'
result $? "a kind of one's own"
printf '%s\n' '(begin (display "one") (newline) 2)' | talk "$socket" 2 >"$scratch/out"
printf '(printed "one\\n")\n(ok 2)\n' | cmp -s - "$scratch/out"
result $? 'what is printed comes before the answer'
printf '1\n2\n\n  \n3\n' | talk "$socket" 3 | tr '\n' ' ' | grep -qx '(ok 1) (ok 2) (ok 3) '
result $? 'answers come in the order of the lines; a blank one has none'
printf '(define door-x 5)\n' | talk "$socket" 1 >/dev/null
answers 'what is defined stays' 'door-x' '(ok 5)'
printf '(exit)\n1\n' | talk "$socket" 2 >"$scratch/out"
empty '(exit) ends the session alone' "$scratch/out"

# ---- The live dive ----

answers 'the live dive is driven' '(drive! #:surge 0.5)' '(ok (0.5 0.0 0.0 0.0))'
await grep -q ' #f64(0.5 ' "$scratch/told"
result $? 'and the house sees it'
printf '%s\n' '(begin (display "round") (let loop () (loop)))' | talk "$socket" 1 >"$scratch/loop" &
talker=$!
await has_lines $(($(wc -l <"$scratch/told") + 5)) "$scratch/told"
result $? 'an endless loop holds up nobody'
answers 'nor another session' '(> (now) 0)' '(ok #t)'
kill $talker
talker=

# ---- What comes by itself ----

printf '(subscribe 50 (begin (display "noise") (list (quote now) (now))))\n' | talk "$socket" 6 >"$scratch/out"
head -n 1 "$scratch/out" | grep -qx '(ok 1)' && [ "$(grep -c '^(event 1 (now [0-9.]*))$' "$scratch/out")" -eq 5 ]
result $? 'a subscription sends what its form returns, and nothing that it prints'
sed -n 's/^(event 1 (now \(.*\)))$/\1/p' "$scratch/out" | sort -g -c
result $? 'as time goes by'
printf '(subscribe 5 (rov-position))\n(subscribe 50 2)\n' | talk "$socket" 60 >"$scratch/out"
slow=$(grep -c '^(event 1 ' "$scratch/out")
fast=$(grep -c '^(event 2 2)$' "$scratch/out")
[ "$slow" -ge 1 ] && [ "$fast" -ge 40 ]
result $? "each at its rate: $slow at 5 a second, $fast at 50"
printf '(subscribe 100 1)\n(unsubscribe 1)\n(unsubscribe 1)\n' | talk "$socket" 9 >"$scratch/out" &
talker=$!
await grep -q '^(error name "unsubscribe: there is no subscription 1; there are ()")$' "$scratch/out"
result $? 'it is ended'
kill $talker
talker=
answers 'at a rate that is none' '(subscribe 0 1)' \
  '(error domain "subscribe: a rate is a number of times a second from 0.01 to 100, not 0")'
answers 'misused' '(subscribe 1)' \
  '(error domain "subscribe: it is used as (subscribe RATE FORM) or (unsubscribe NUMBER)")'
printf '(define n 3)\n(subscribe 100 (begin (set! n (- n 1)) (/ 1 n)))\n(+ 1 1)\n' | talk "$socket" 6 >"$scratch/out"
grep -q '^(ended 1 numerical-overflow "' "$scratch/out" && [ "$(grep -c '^(event' "$scratch/out")" -eq 2 ]
result $? 'an error is told, and ends it'

# ---- Lines that are none ----

for line in '(' ')' '"open' '#<object>' '1 2' '(a . b . c)' '#\\nosuch'; do
  printf '%s\n(+ 20 22)\n' "$line" | talk "$socket" 2 >"$scratch/out"
  grep -q '^(error ' "$scratch/out" && tail -n 1 "$scratch/out" | grep -qx '(ok 42)'
  result $? "a line that cannot be read is refused, and the next is done: $line"
done
{ printf '\377\376"\n'; printf '(+ 20 22)\n'; } | talk "$socket" 2 >"$scratch/out"
grep -q '^(error ' "$scratch/out" && grep -qx '(ok 42)' "$scratch/out"
result $? 'so are bytes that are no text'
{ head -c 3000000 /dev/zero | tr '\0' 'x'; printf '\n(+ 20 22)\n'; } | talk "$socket" 2 >"$scratch/out"
head -n 1 "$scratch/out" | grep -q '^(error limit "a line has 262144 bytes' && tail -n 1 "$scratch/out" | grep -qx '(ok 42)'
result $? 'so is a line that is too long'
{ head -c 200000 /dev/zero | tr '\0' '('; printf '\n(+ 20 22)\n'; } | talk "$socket" 2 >"$scratch/out"
head -n 1 "$scratch/out" | grep -q '^(error ' && tail -n 1 "$scratch/out" | grep -qx '(ok 42)'
result $? 'and one that nests without end'
answers 'a value without end is refused' '(let ((l (list 1 2))) (set-cdr! (cdr l) l) l)' \
  '(error limit "the value has more than 1000000 parts")'
printf '(begin (let loop ((i 0)) (when (< i 100000) (display "0123456789") (loop (+ i 1)))) 7)\n' \
  | talk "$socket" 2 >"$scratch/out"
[ "$(wc -c <"$scratch/out")" -lt 70000 ] && tail -n 1 "$scratch/out" | grep -qx '(ok 7)'
result $? 'of what is printed without end only the beginning is told'
printf '(+ 1' | talk "$socket" 0
answers 'a client that leaves in the middle of a line disturbs nobody' '(+ 1 1)' '(ok 2)'
grep -v 'listening at' "$scratch/err" >"$scratch/noise"
empty 'sessions leave no noise on the terminal' "$scratch/noise"

# ---- From Python ----

if python3 -c 1 >/dev/null 2>&1; then
  cat >"$scratch/fly.py" <<'PY'
import math, sys, time
from door import Door

door = Door(sys.argv[1])
text = 'a\n"\\é\x1b\a\b\f\t\v\0\r\u200b\U000e0001'
assert door.ask("(list 1 -2.5 1/4 #t #f (list->string (map integer->char '(%s))) 'word (list))"
                % " ".join(str(ord(c)) for c in text)) == [1, -2.5, 0.25, True, False, text, "word", []]
assert door.ask("(if #f #f)") is None and math.isnan(door.ask("(/ 0. 0.)"))
assert door.ask("(drive! #:surge 0.25)") == [0.25, 0, 0, 0]
number = door.ask("(subscribe 50 (list (now) (tether-length)))")
assert [door.event()[:2] for i in range(3)] == [["event", number]] * 3
assert len(door.ask("(rov-position)")) == 3  # while events come
door.ask("(unsubscribe %d)" % number)
try:
    door.ask("(drive! #:surge 9)")
    raise SystemExit("no error")
except RuntimeError as error:
    assert str(error).startswith("domain: drive!: "), error
begun = time.perf_counter()
for i in range(200):
    door.ask("(rov-position)")
print("a round trip takes %.2f ms" % ((time.perf_counter() - begun) / 200 * 1e3))
PY
  PYTHONPATH=$top_srcdir/doc PYTHONDONTWRITEBYTECODE=1 python3 "$scratch/fly.py" "$socket" >"$scratch/out" 2>&1
  flown=$?
  result $flown 'the client for Python drives, subscribes and raises what went wrong'
  diag "$(cat "$scratch/out")"
else
  skip 'there is no Python here'
fi

# ---- Beside a prompt ----

kill "$house"
wait "$house" 2>/dev/null
house=
"$pre" bight --door="$socket" --listen="$scratch/prompt" -c "(display (list (file-exists? \"$scratch/prompt\")
  (file-exists? \"$socket\")))" >"$scratch/out" 2>"$scratch/err"
[ "$(cat "$scratch/out")" = '(#t #t)' ] && [ ! -e "$socket" ] && [ ! -e "$scratch/prompt" ]
result $? 'a door and a prompt stand beside each other, and are taken away'
"$pre" bight --door -c 1 >"$scratch/out" 2>"$scratch/err"
grep -q "listening at $XDG_RUNTIME_DIR/bight/[0-9]*\\.door\$" "$scratch/err"
result $? 'the usual place has an ending of its own'
finish
