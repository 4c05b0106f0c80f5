# A prompt on a socket: its owner's alone, beside the flight, and no endless loop there stops anything.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/socket.sh"

# say SOCKET EXPR: what the prompt there answers.
cat >"$scratch/say.scm" <<'SCM'
(use-modules (ice-9 rdelim))
(define arguments (cdr (program-arguments)))
(define s (socket PF_UNIX SOCK_STREAM 0))
(connect s AF_UNIX (list-ref arguments 0))
(display (list-ref arguments 1) s)
(display "\n'all-is-said\n" s)
(force-output s)
;; Until it has answered what was sent last, and waits for more.
(let loop ((text ""))
  (unless (and (string-contains text "all-is-said") (string-suffix? "scheme@(guile-user)> " text))
    (let ((c (read-char s)))
      (unless (eof-object? c)
        (display c)
        (force-output)
        (loop (string-append text (string c)))))))
(newline)
SCM

say ()
{
  "$pre" "$GUILE" -s "$scratch/say.scm" "$@"
}

begin_house --listen
say "$socket" "(drive! #:surge 0.5)" >"$scratch/out"
grep -q 'scheme@(guile-user)> ' "$scratch/out" && grep -q '#f64(0.5 ' "$scratch/out"
driven=$?
result $driven 'the live dive is driven from there, at the prompt that editors know'
[ $driven -eq 0 ] || diag "$(cat "$scratch/out")"
await grep -q ' #f64(0.5 ' "$scratch/told"
result $? 'and the house sees it'
"$pre" "$GUILE" -s "$scratch/say.scm" "$socket" "(begin (display 'round) (force-output) (let loop () (loop)))" \
  >"$scratch/loop" &
talker=$!
await grep -q round "$scratch/loop"
await has_lines $(($(wc -l <"$scratch/told") + 5)) "$scratch/told"
result $? 'an endless loop there holds up nobody'
say "$socket" "(> (now) 0)" >"$scratch/out"
grep -q '#t' "$scratch/out"
result $? 'nor another session'
# What Geiser 0.10 defines when an editor connects, and what C-x C-e sends.
say "$socket" "(use-modules (system repl command))
(define-meta-command ((geiser-eval geiser) repl (mod form args) . rest) \"what an editor evaluates\"
  (write (list 'editor mod (and (null? args) (eval form (current-module))))))
,geiser-eval #f (+ 1 2) ()" >"$scratch/out"
grep -q '(editor #f 3)' "$scratch/out"
evaluated=$?
result $evaluated 'an editor evaluates data'
[ $evaluated -eq 0 ] || diag "$(cat "$scratch/out")"
kill $talker
talker=
say "$socket" "(freeze!)" >"$scratch/out"
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
