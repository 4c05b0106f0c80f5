# A dive loads no library that it does not use: its memory map is looked into while it runs.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
heavy='/[^ ]*(librender|bight-render|libOSMesa|libGL|libEGL|libassimp|libgdal|libproj|libsqlite3|bight-sqlite|libchafa|bight-chafa|bight-pilot|libSDL2|bight-controller|bight-identify|bight-telemetry|bight-sampler)[^ ]*'
dive="(enter! (world (sea (depth 40) (current 0.3 90) (waves (airy (height 1) (period 6) (toward 90)))) (seabed)
  (box (named block) (at 10 10 -5) (size 2 2 2)) (rov (named rov) (at 0 20 -10))
  (tether (from 0 0 0) (to rov) (length 30) (model dynamic))))
  (drive! #:surge 0.3 #:yaw 0.2) (run 10)"
maps="(call-with-input-file \"/proc/self/maps\"
  (lambda (port) (let loop ((c (read-char port))) (unless (eof-object? c) (write-char c) (loop (read-char port))))))"

# What of the heavy libraries is mapped at the end of the expression $1.
mapped ()
{
  (cd "$scratch" && "$pre" bight -c "$1 $maps" </dev/null 2>"$scratch/err") >"$scratch/maps"
  status=$?
  grep -oE "$heavy" "$scratch/maps" | sort -u >"$scratch/heavy"
  return $status
}

mapped "$dive"
result $? 'a dive with sea, obstacles and a moving line runs'
grep -q libguile "$scratch/maps"
result $? 'its memory map is seen'
empty 'no picture, mesh, database or terminal library in it' "$scratch/heavy"

# Or else nothing would be seen above.
if mapped "$dive (snapshot \"picture.png\" #:size '(64 48))"; then
  grep -q render "$scratch/heavy"
  result $? 'after a picture the renderer is seen there'
else
  diag "no picture can be drawn here: $(tail -n 1 "$scratch/err")"
fi
finish
