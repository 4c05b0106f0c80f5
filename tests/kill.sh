# What is recorded and logged survives kill -9: every file opens, and lacks at most the last second.
# BIGHT_KILLS=1000 for a long run.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

kills=${BIGHT_KILLS:-10}
bight=$top_builddir/pre-inst-env

# Dive, record, and tell how far it is: (TIME) on a line.
cat >"$scratch/dive.scm" <<'SCM'
(enter! 'pile)
(apply record! (cdr (program-arguments)))
(drive! #:surge 0.6 #:yaw 0.1)
(let loop ((i 0))
  (drive! #:sway (/ (modulo i 7) 10))
  (run 0.25)
  (write (now))
  (newline)
  (force-output)
  (loop (+ i 1)))
SCM

# For each RECORDING and what its diver last said: one line if something is lost.
cat >"$scratch/look.scm" <<'SCM'
(define (last-said file)
  (call-with-input-file file
    (lambda (port)
      (let loop ((last 0.0))
        (let ((next (read port)))
          (if (number? next) (loop next) last))))))
(for-each
 (lambda (file)
   (when (file-exists? file)
     (let ((said (last-said (string-append file ".said"))))
       (catch #t
         (lambda ()
           (let ((outcome (replay file #:enter #t)))
             (unless (eq? 'identical outcome)
               (simple-format #t "~a: ~a\n" file outcome))
             (when (> said (+ 1 (now)))
               (simple-format #t "~a: it goes to ~a, the dive went to ~a\n" file (now) said))))
         (lambda args
           (when (> said 0)
             (simple-format #t "~a: ~a\n" file args)))))))
 (cdr (program-arguments)))
SCM

i=0
while [ $i -lt "$kills" ]; do
  file=$scratch/$i.rec
  "$bight" bight "$scratch/dive.scm" "$file" >"$file.said" 2>"$file.err" &
  diver=$!
  # Two of three are under way; the third dies any time after it was started.
  [ $((i % 3)) -eq 0 ] || await has_lines 1 "$file.said"
  moment $((i * 7 % 5))
  kill -9 $diver
  wait $diver 2>/dev/null
  i=$((i + 1))
done
cat "$scratch"/*.rec.err >"$scratch/errors"
empty "nothing goes wrong while $kills dives are recorded" "$scratch/errors"
"$bight" bight "$scratch/look.scm" "$scratch"/*.rec >"$scratch/lost" 2>&1
empty "each of $kills recordings opens and lacks at most its last second" "$scratch/lost"
cat "$scratch"/*.rec.said | grep -q .
result $? 'some of them were under way'

# ---- The logbook: many writers, some of whom die ----

BIGHT_LOGBOOK=$scratch/logbook.db
export BIGHT_LOGBOOK
if "$bight" bight -c '(logbook)' >/dev/null 2>"$scratch/no-logbook"; then
  writer='(do ((i 0 (+ i 1))) ((= i 25)) (log-probe! "?" #:trainee (cadr (program-arguments)) #:score i))'
  writers=
  for who in ada grace edith mary; do
    "$bight" bight -c "$writer" $who >>"$scratch/writers" 2>&1 &
    writers="$writers $!"
  done
  "$bight" bight -c '(let loop () (log-probe! "?" #:trainee "killed") (loop))' >/dev/null 2>&1 &
  diver=$!
  for writer in $writers; do
    wait "$writer" || echo "a writer failed" >>"$scratch/writers"
  done
  kill -9 $diver
  wait $diver 2>/dev/null
  empty 'four write at a time, and a fifth dies' "$scratch/writers"
  "$bight" bight -c '(unless (= 100 (- (length (logbook)) (length (logbook #:trainee "killed")))) (display "lost"))' \
    >"$scratch/lost" 2>&1
  empty 'every entry is there' "$scratch/lost"
else
  skip 'built without SQLite'
fi
finish
