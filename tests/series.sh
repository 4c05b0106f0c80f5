# Time series for other programs: NumPy's .npz, VTK's .vtp and .pvd and animated glTF, read back, and by NumPy, VTK and
# assimp where they are (Debian packages python3-numpy, python3-vtk9 and libassimp-dev).
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
bight ()
{
  "$pre" bight "$@"
}
cd "$scratch" || exit 99

cat >fly.scm <<'SCM'
(use-modules (ice-9 binary-ports) (ice-9 iconv) (rnrs bytevectors) (srfi srfi-1) (srfi srfi-4) (ice-9 textual-ports))
(enter! 'pile)
(record! "dive.rec" #:frames "dive.db")
(define samples (sample! 0.5 (max-tension) (f64vector-ref (rov-position) 0) (max-tension) 'none))
(fly-to! '(3 1 -5))
(run 4)
(stop-recording!)
(define (show . words) (for-each display words) (newline))
(show "names " (export-npz samples "samples.npz"))
(show "names " (export-npz "dive.db" "dive.npz"))
(show "frames " (export-vtk "dive.db" "dive.pvd"))
(show "moments " (export-gltf "dive.db" "dive.glb" #:radius 0.05))

;; Read back: the archive by its local entries, each stored.
(define (u bytes at size) (bytevector-uint-ref bytes at (endianness little) size))
(define (text bytes from to)
  (utf8->string (u8-list->bytevector (map (lambda (i) (bytevector-u8-ref bytes i)) (iota (- to from) from)))))
(define (entries bytes)
  (let loop ((at 0) (found '()))
    (if (= #x04034b50 (u bytes at 4))
        (let* ((name-end (+ at 30 (u bytes (+ at 26) 2))) (end (+ name-end (u bytes (+ at 18) 4)))
               (head-end (+ name-end 10 (u bytes (+ name-end 8) 2))))
          (loop end
                (acons (text bytes (+ at 30) name-end)
                       (cons (text bytes (+ name-end 10) head-end)
                             (map (lambda (i) (bytevector-ieee-double-ref bytes i (endianness little)))
                                  (iota (/ (- end head-end) 8) head-end 8)))
                       found)))
        (reverse found))))
(define (file-bytes name) (call-with-input-file name get-bytevector-all #:binary #t))
(define query (@@ (bight core sqlite) %query))
(define database ((@@ (bight core sqlite) %open-database) "dive.db"))
(define (asked sql) (concatenate (query database sql '())))
(define dive (entries (file-bytes "dive.npz")))
(define (same? name sql) (equal? (cdr (assoc-ref dive name)) (map exact->inexact (asked sql))))
(show "time " (same? "time.npy" "select time from frames order by frame"))
(show "rov " (same? "minnow.position.npy" "select x, y, z from vehicles order by frame"))
(show "points " (equal? (filter (lambda (x) (= x x)) (cdr (assoc-ref dive "line.points.npy")))
                        (asked "select x, y, z from points order by frame, node")))
(show "shape " (car (assoc-ref dive "line.points.npy")))
(show "counts " (query database "select count(*), max(n) from (select count(*) as n from points group by frame)" '()))
(show "sampled " (equal? (cddr (assoc-ref (entries (file-bytes "samples.npz")) "max-tension.npy"))
                         (map cadr (cdr (samples-rows samples)))))
;; The numbers of a .vtp stand behind the XML, each array after its size; the third are the points.
(define vtp (file-bytes "dive/000000.vtp"))
(define mark (+ 2 (string-contains (bytevector->string vtp "ISO-8859-1") ">\n_")))
(define (array at) (let ((n (u vtp at 8))) (cons n (+ at 8))))
(define tension (array (+ mark 1)))
(define part (array (+ (cdr tension) (car tension))))
(define points (array (+ (cdr part) (car part))))
(show "vtp " (equal? (map (lambda (i) (bytevector-ieee-double-ref vtp (+ (cdr points) (* 8 i)) (endianness little)))
                          (iota (/ (car points) 8)))
                     (append (asked "select x, y, z from vehicles where frame = 1")
                             (asked "select x, y, z from points where frame = 1 order by node"))))
;; What an animation has at each key: the vehicle, and both ends of the line.
(define last-node (apply max (asked "select node from points where frame = 1")))
(with-output-to-file "keys"
  (lambda ()
    (define (keys name sql)
      (for-each (lambda (row k) (show "key " name " " k " " (string-join (map number->string row) " ")))
                (query database sql '()) (iota (car (asked "select count(*) from frames")))))
    (keys "minnow" "select time, x, y, z from frames natural join vehicles order by frame")
    (keys "line-0" "select time, x, y, z from frames natural join points where node = 0 order by frame")
    (keys (string-append "line-" (number->string last-node))
          (string-append "select time, x, y, z from frames natural join points where node = "
                         (number->string last-node) " order by frame"))))
(show "nodes " (+ 1 last-node))
(show "last " (last (asked "select time from frames order by frame")))
SCM
bight fly.scm >out 2>err
status=$?
if grep -q 'without SQLite' err; then
  skip 'there are no frames without SQLite'
  finish
fi
result $status 'a dive is flown and written'
[ $status -eq 0 ] || diag "$(cat err)"
grep -qx 'names (time max-tension f64vector-ref__rov-position__0 max-tension-2 quote_none)' out
named=$?
result $named 'samples have an array for each expression, under names that differ'
[ $named -eq 0 ] || diag "$(cat out)"
grep -qx 'names (time step minnow.position .*line.points line.tension)' out
result $? 'a recording has one for each quantity'
for what in time rov points sampled vtp; do
  grep -qx "$what #t" out
  result $? "what is read back is what was written: $what"
done
frames=$(sed -n 's/^frames //p' out)
nodes=$(sed -n "s/^counts ((\\([0-9]*\\) \\([0-9]*\\)))/\\2/p" out)
grep -q "'shape': ($frames, $nodes, 3, )" out
result $? "its shape is frames, nodes, coordinates: $frames, $nodes, 3"
[ "$(ls dive/*.vtp | wc -l)" -eq "$frames" ] && [ "$(grep -c '<DataSet timestep=' dive.pvd)" -eq "$frames" ]
result $? 'the series names a file for each frame'

with_python () # MODULE: a Python that has it
{
  for python in python3 /usr/bin/python3; do
    if "$python" -c "import $1" >/dev/null 2>&1; then
      echo "$python"
      return
    fi
  done
}
python=$(with_python numpy)
if [ -n "$python" ]; then
  cat >read.py <<'PY'
import numpy, sqlite3, zipfile
assert zipfile.ZipFile("dive.npz").testzip() is None
dive = numpy.load("dive.npz", allow_pickle=False)
base = sqlite3.connect("dive.db")
times = [t for t, in base.execute("select time from frames order by frame")]
assert dive["time"].tolist() == times and dive["line.nodes"].shape == (len(times),)
for i, (frame,) in enumerate(base.execute("select frame from frames order by frame").fetchall()):
    rows = base.execute("select x, y, z from points where frame = ? order by node", (frame,)).fetchall()
    assert (dive["line.points"][i, :len(rows)] == numpy.array(rows)).all()
    assert numpy.isnan(dive["line.points"][i, len(rows):]).all()
assert dive["minnow.position"].shape == (len(times), 3)
samples = numpy.load("samples.npz", allow_pickle=False)
assert numpy.isnan(samples["quote_none"]).all() and len(samples["time"]) == 9
PY
  check 'NumPy reads it' "$python" read.py
else
  skip 'NumPy is not here'
fi
python=$(with_python vtk)
if [ -n "$python" ]; then
  cat >view.py <<'PY'
import re, sqlite3, vtk
base = sqlite3.connect("dive.db")
files = re.findall(r'timestep="([^"]*)" part="0" file="([^"]*)"', open("dive.pvd").read())
for (time, name), (frame, at) in zip(files, base.execute("select frame, time from frames order by frame").fetchall()):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.Update()
    data = reader.GetOutput()
    rows = base.execute("select x, y, z from vehicles where frame = ?", (frame,)).fetchall() \
        + base.execute("select x, y, z from points where frame = ? order by node", (frame,)).fetchall()
    assert float(time) == at and data.GetNumberOfPoints() == len(rows) and data.GetNumberOfLines() == 1
    assert [data.GetPoint(i) for i in range(len(rows))] == rows
    tension = [t for t, in base.execute("select tension from points where frame = ? order by node", (frame,))]
    read = [data.GetPointData().GetArray("tension").GetValue(i + 1) for i in range(len(tension))]
    assert all(a == b or (b is None and a != a) for a, b in zip(read, tension))
PY
  check "VTK's reader opens every frame" "$python" view.py
else
  skip 'VTK is not here'
fi

if pkg-config --exists assimp 2>/dev/null && [ "$sanitize" != yes ] &&
  ${CC:-cc} -o gltf "$top_srcdir/tests/gltf.c" $(pkg-config --cflags --libs assimp) -lm 2>err; then
  ./gltf dive.glb >read
  result $? "assimp's reader opens an animation"
  sort -k 2,3 keys >wanted
  cut -d ' ' -f 2 keys | sort -u >names
  awk 'NR == FNR { want[$1]; next } $2 in want' names read | sort -k 2,3 >found
  paste -d ' ' wanted found | awk '
    function far(a, b) { return a - b > 1e-4 || b - a > 1e-4 }
    $2 != $9 || $3 != $10 { wrong++ }
    { for (i = 4; i <= 7; i++) if (far($i, $(i + 7))) wrong++ }
    END { exit !(NR > 60 && !wrong) }'
  moved=$?
  result $moved 'vehicle and ends of the line are where they were at each key'
  [ $moved -eq 0 ] || diag "$(paste -d ' ' wanted found | head -5)"
  grep -qx "tube $(sed -n 's/^nodes //p' out) bones, radius 0.0500" read
  result $? 'a tube of that radius lies about its joints'
else
  skip 'assimp is not here'
fi

# ---- Mistakes, and files that are not what they seem ----

refused () # NAME TEXT EXPRESSION
{
  bight -c "$3" >out 2>err
  [ $? -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && grep -qF -e "$2" err
  refusal=$?
  result $refusal "$1 is refused"
  [ $refusal -eq 0 ] || diag "$(cat out err)"
}
echo 'no database, but long enough to be taken for one by its name alone' >text.db
refused 'no recording' 'there is no file "none.db"' '(export-npz "none.db" "x.npz")'
refused 'a text' 'not a database of frames; (record!' '(export-vtk "text.db" "x.pvd")'
refused 'a text as rows' 'not a database of frames; (record!' '(export-csv "text.db" "x.csv")'
refused 'a device' 'not a database of frames; (record!' '(export-gltf "/dev/null" "x.glb")'
refused 'a folder' 'is a folder' '(export-npz "dive" "x.npz")'
refused 'what is neither' 'it writes samples' '(export-npz 5 "x.npz")'
refused 'a series without its ending' 'NAME.pvd' '(export-vtk "dive.db" "dive.vtp")'
refused 'an animation without its ending' 'NAME.glb' '(export-gltf "dive.db" "dive.gltf")'
refused 'a place that cannot be' 'there is no folder' '(export-npz "dive.db" "/none/x.npz")'
: >taken
refused 'a file in the place of the folder' 'is no folder' '(export-vtk "dive.db" "taken.pvd")'
[ ! -e x.npz ] && [ ! -e x.pvd ] && [ ! -e taken.pvd ]
result $? 'and nothing is left of it'
cp dive.db forged.db
cat >forge.scm <<'SCM'
(define database ((@@ (bight core sqlite) %open-database) "forged.db"))
(for-each (lambda (sql) ((@@ (bight core sqlite) %query) database sql '()))
          '("update points set x = 'many', tension = 1e999, node = 9000000000000000000 - node"
            "update vehicles set name = '../../evil\"<&'"
            "update frames set time = 'now' where frame = 2"))
SCM
bight forge.scm >out 2>err || diag "$(cat err)"
bight -c '(export-npz "forged.db" "forged.npz")' >out 2>err && grep -q '"evil___.position"' out && \
  bight -c '(export-vtk "forged.db" "forged.pvd")' >out 2>>err && [ ! -e ../../evil ] && \
  bight -c '(export-gltf "forged.db" "forged.glb")' >out 2>>err && [ "$(cat out)" = "$((frames - 1))" ]
forged=$?
result $forged 'what is no number in a forged recording is none in the file, and its names are harmless'
[ $forged -eq 0 ] || diag "$(cat out err)"
finish
