# A study of twelve short dives and what one process makes of it, for the shell tests that sweep it in other ways;
# read with `.' after tap.sh.  Without SQLite the test is skipped.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

pre=$top_builddir/pre-inst-env
bight ()
{
  "$pre" bight "$@"
}
cd "$scratch" || exit 99

# begin_study [FORM]: quick.scm, each of whose flights begins with FORM; `one' is the fingerprint of its results.
begin_study ()
{
  cat >quick.scm <<SCM
(define-study quick
  "Twelve short dives."
  #:for ((U 0 0.3) (push 0.2 0.5 0.8) (seed (seeds 2)))
  (in (with open-water (current U 90)))
  (fly ${1:-} (drive! #:surge push #:yaw (random 0.5)) (run 0.25))
  (measure (slack (slack))))
SCM
  if bight sweep quick.scm -o one.db 2>&1 | grep -q 'without SQLite'; then
    skip 'there are no sweeps without SQLite'
    finish
  fi
  one=$(bight sweep quick.scm -o one.db | sed -n 's/.*12 done (0 now), fingerprint //p')
  [ -n "$one" ]
  result $? 'a sweep, here, by one process'
}
