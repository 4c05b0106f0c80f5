# The worlds that programs in C have of testbed/gallery.h are those that `enter!' makes: dives in both begin in
# the same state and come to the same, bit for bit.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

"$top_builddir/testbed/gallery-hashes" >"$scratch/in-c" 2>"$scratch/err"
result $? 'dives in all worlds are flown by a program in C'
diag "$(cat "$scratch/err")"

cat >"$scratch/fly.scm" <<'EOF2'
(define (fly file)
  (let ((world (find-world file #:trust #t)))
    (enter! world)
    (format #t "~a ~a" (world-name world) (state-hash))
    (for-each (lambda (sticks)
                (apply drive! sticks)
                (run 1/2)
                (format #t " ~a" (state-hash)))
              '((#:surge 0.5 #:sway 0 #:heave 0.25 #:yaw 0) (#:surge 0 #:sway -0.5 #:heave 0 #:yaw 0.5)))
    (newline)))
(for-each fly (cdr (program-arguments)))
EOF2
"$top_builddir/pre-inst-env" bight "$scratch/fly.scm" "$top_srcdir"/worlds/*.scm "$top_srcdir"/testbed/worlds/*.scm \
  >"$scratch/in-scheme" 2>"$scratch/err"
result $? 'and by the language'
diag "$(cat "$scratch/err")"

sort "$scratch/in-c" >"$scratch/one"
sort "$scratch/in-scheme" >"$scratch/two"
diff "$scratch/one" "$scratch/two" >"$scratch/differ"
empty 'each begins in the same state and comes to the same' "$scratch/differ"
finish
