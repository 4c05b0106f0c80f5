# A prompt on a socket: its owner's alone, beside the flight, and no endless loop there stops anything.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
XDG_RUNTIME_DIR=$scratch/run
export XDG_RUNTIME_DIR
mkdir -m 700 "$XDG_RUNTIME_DIR"
house=
trap '[ -z "$house" ] || kill "$house" 2>/dev/null; rm -rf "$scratch"' EXIT

# say SOCKET SECONDS EXPR: what the prompt there answers within that time.
cat >"$scratch/say.scm" <<'SCM'
(use-modules (ice-9 rdelim))
(define arguments (cdr (program-arguments)))
(define s (socket PF_UNIX SOCK_STREAM 0))
(define (elapsed from) (/ (- (get-internal-real-time) from) internal-time-units-per-second 1.0))
(connect s AF_UNIX (list-ref arguments 0))
(display (list-ref arguments 2) s)
(newline s)
(force-output s)
(define begun (get-internal-real-time))
(define seconds (string->number (list-ref arguments 1)))
;; Until the prompt is there again, after the one at the beginning.
(define prompt "scheme@(guile-user)> ")
(define (prompts text)
  (let loop ((from 0) (n 0))
    (let ((i (string-contains text prompt from)))
      (if i (loop (+ i 1) (+ n 1)) n))))
(let loop ((text ""))
  (let ((left (- seconds (elapsed begun))))
    (if (or (<= left 0) (>= (prompts text) 2))
        (display text)
        (if (pair? (car (select (list s) '() '() 0 (inexact->exact (floor (* 1e6 (min left 0.2)))))))
            (let ((c (read-char s)))
              (if (eof-object? c) (display text) (loop (string-append text (string c)))))
            (loop text)))))
(newline)
SCM

say ()
{
  "$pre" "$GUILE" -s "$scratch/say.scm" "$@"
}

wait_for ()
{
  left=100
  until [ -S "$1" ] || [ $left -eq 0 ]; do
    left=$((left - 1))
    sleep 0.1
  done
  [ -S "$1" ]
}

# The house lets a dive go live, and tells twice a second how far it is.
cat >"$scratch/house.scm" <<'SCM'
(enter! 'pile)
(live!)
(let loop ((i 0))
  (when (< i 600)
    (write (list (now) (sticks)))
    (newline)
    (force-output)
    (usleep 250000)
    (loop (+ i 1))))
SCM

socket=$scratch/socket
"$pre" bight --listen="$socket" "$scratch/house.scm" >"$scratch/told" 2>"$scratch/err" &
house=$!
wait_for "$socket"
result $? 'a socket is there'
[ "$(stat -c %a "$socket")" = 600 ]
result $? 'for its owner alone'
left=100
until [ -s "$scratch/told" ] || [ $left -eq 0 ]; do
  left=$((left - 1))
  sleep 0.1
done
say "$socket" 10 "(drive! #:surge 0.5)" >"$scratch/out"
grep -q 'scheme@(guile-user)> ' "$scratch/out" && grep -q '#f64(0.5 ' "$scratch/out"
driven=$?
result $driven 'the live dive is driven from there, at the prompt that editors know'
[ $driven -eq 0 ] || diag "$(cat "$scratch/out")"
sleep 0.6
tail -1 "$scratch/told" | grep -q '0.5'
result $? 'and the house sees it'
say "$socket" 1 "(let loop () (loop))" >/dev/null
before=$(wc -l <"$scratch/told")
sleep 1
[ "$(wc -l <"$scratch/told")" -gt "$before" ]
result $? 'an endless loop there holds up nobody'
say "$socket" 10 "(> (now) 1)" >"$scratch/out"
grep -q '#t' "$scratch/out"
result $? 'nor another session'
say "$socket" 10 "(freeze!)" >"$scratch/out"
grep -q 'frozen there alone' "$scratch/out"
result $? 'the house alone freezes its dive'
"$pre" bight --listen="$socket" -c 1 >"$scratch/out" 2>&1
[ $? -eq 1 ] && grep -q 'somebody listens at' "$scratch/out"
result $? 'one listens at a socket'
grep -v 'listening at' "$scratch/err" >"$scratch/noise"
empty 'sessions leave no noise on the terminal' "$scratch/noise"
kill "$house"
wait "$house" 2>/dev/null
house=

"$pre" bight --listen="$socket" -c 1 >"$scratch/out" 2>"$scratch/err"
result $? 'a socket left behind is in nobody'\''s way'
[ ! -e "$socket" ]
result $? 'and is taken away at the end'
"$pre" bight --listen -c 1 >"$scratch/out" 2>"$scratch/err"
grep -q "listening at $XDG_RUNTIME_DIR/bight/" "$scratch/err" \
  && [ "$(stat -c %a "$XDG_RUNTIME_DIR/bight")" = 700 ]
result $? 'the usual place is a folder of one'\''s own'
chmod 755 "$XDG_RUNTIME_DIR/bight"
"$pre" bight --listen -c 1 >"$scratch/out" 2>"$scratch/err"
[ $? -eq 1 ] && grep -q 'must be yours alone' "$scratch/err"
result $? 'or none is used'
echo 1 >"$scratch/file"
"$pre" bight --listen="$scratch/file" -c 1 2>"$scratch/err"
[ $? -eq 1 ] && grep -q 'is no socket' "$scratch/err" && [ "$(cat "$scratch/file")" = 1 ]
result $? 'a file is never replaced'
finish
