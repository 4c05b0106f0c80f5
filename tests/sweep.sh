# Sweeps: the same result whoever flies it and however often it is killed; shards, on machines too; what goes
# wrong is told.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
bight ()
{
  "$pre" bight "$@"
}
cd "$scratch" || exit 99

# Each flight is noted in the file CASE_LOG; from the CASE_STOP-th on it waits until there is a file `go'.
cat >quick.scm <<'SCM'
(define (note! . words)
  (when (getenv "CASE_LOG")
    (let ((port (open-file (getenv "CASE_LOG") "a")))
      (write words port)
      (newline port)
      (close-port port))))
(define (lines-noted)
  (let ((text (call-with-input-file (getenv "CASE_LOG") (@ (ice-9 textual-ports) get-string-all))))
    (string-count text #\newline)))
(define (hold-on)
  (when (getenv "CASE_STOP")
    (let loop ()
      (when (and (>= (lines-noted) (string->number (getenv "CASE_STOP"))) (not (file-exists? "go")))
        (usleep 10000)
        (loop)))))
(define-study quick
  "Twelve short dives."
  #:for ((U 0 0.3) (push (uniform 0.2 0.8)) (seed (seeds 2)))
  (latin-hypercube 3)
  (in (with open-water (current U 90)))
  (fly (note! (getpid) U push seed) (hold-on))
  (leg out (drive! #:surge push #:yaw (random 0.5)) (run 0.25))
  (leg on (run 0.25))
  (measure (slack (slack)) (east? (> (range-to '(0 0 -5)) 1)) (side (if (> push 0.5) 'fast 'slow))))
SCM

if bight sweep --table none.db 2>&1 | grep -q 'without SQLite'; then
  bight sweep quick.scm 2>err
  [ $? -eq 1 ] && grep -q 'sweep: this bight was built without SQLite' err
  result $? 'without SQLite a sweep says what is missing'
  finish
fi

# ---- The same result in every way ----

print_of () # RESULT [STUDY]: the fingerprint of all its rows, told by a sweep that finds nothing to do
{
  bight sweep "${2:-quick.scm}" -o "$1" | sed -n 's/.*done (0 now), fingerprint //p'
}

bight sweep quick.scm -o one.db -j 1 >out 2>err
result $? 'a sweep succeeds'
empty 'and has nothing to complain about' err
grep -q '^one.db: 12 cases: 12 done (12 now), fingerprint [0-9a-f]\{16\}$' out
result $? 'it tells what it did'
one=$(print_of one.db)
[ -n "$one" ]
result $? 'again, nothing is left to do'
bight sweep --rows one.db >one.csv
[ "$(wc -l <one.csv)" -eq 13 ] && [ "$(sort -u one.csv | wc -l)" -eq 13 ]
result $? 'twelve cases, no two the same'

bight -c '(use-modules (bight core sqlite))
  (%query (%open-database "one.db") "select count(*), sum(cpu) > 0, count(distinct hash) from cases" (list))' >out
[ "$(cat out)" = '((12 1 12))' ]
result $? 'each with its processor time and the hash of its own state'

bight sweep quick.scm -o three.db -j 3 >out 2>&1
bight sweep --rows three.db | cmp -s - one.csv && [ "$(print_of three.db)" = "$one" ]
result $? 'three at a time: the same'

for i in 1 2 3; do
  bight sweep quick.scm -j 1 --shard $i/3 >>out 2>&1
done
bight sweep --merge merged.db quick.?-of-3.db >merged
result $? 'three shards are merged'
grep -q 'merged.db: 12 cases: 12 done (12 now)' merged
result $? 'into all cases'
bight sweep --rows merged.db | cmp -s - one.csv && [ "$(print_of merged.db)" = "$one" ]
result $? 'the same'
bight sweep --merge merged.db quick.?-of-3.db | grep -q '12 done (0 now)'
result $? 'merging again changes nothing'

# ---- Killed, and stopped ----

cases_noted () # FILE: without the process that flew each
{
  sed 's/^([0-9]* //' "$1"
}

CASE_LOG=$scratch/flown CASE_STOP=6 "$pre" bight sweep quick.scm -o killed.db -j 2 >out 2>&1 &
master=$!
await has_lines 6 flown
kill -9 $master
wait $master 2>/dev/null
await gone $(sed 's/^(\([0-9]*\) .*/\1/' flown) && [ "$(wc -l <flown)" -le 7 ]
result $? 'with its master killed, no case goes on'
touch go
had=$(($(bight sweep --rows killed.db | wc -l) - 1))
[ "$had" -ge 3 ] && [ "$had" -le 7 ]
result $? "half of it ($had cases) is there"
CASE_LOG=$scratch/flown bight sweep quick.scm -o killed.db -j 2 >out 2>&1
grep -q "12 done ($((12 - had)) now), fingerprint $one" out
result $? 'started again it flies what is missing, and comes to the same'
[ "$(cases_noted flown | sort -u | wc -l)" -eq 12 ] && [ "$(wc -l <flown)" -le 15 ]
result $? 'no case that was done is flown again'

rm go
CASE_LOG=$scratch/stopped CASE_STOP=3 "$pre" bight sweep quick.scm -o stopped.db -j 1 >out 2>err &
master=$!
await has_lines 3 stopped
kill -INT $master
touch go
wait $master
[ $? -eq 1 ] && grep -q '^bight: sweep: stopped; `bight sweep quick.scm -j 1 -o stopped.db. goes on$' err
result $? '^C stops it and tells how to go on'
bight sweep quick.scm -o stopped.db >out 2>&1
grep -q "fingerprint $one" out
result $? 'and so it does'

# The same processes run tests.
cat >forever.scm <<'SCM'
(define-scenario forever
  "It tells its process, and goes on."
  (call-with-output-file "process" (lambda (port) (write (getpid) port) (newline port)))
  (let loop () (loop)))
SCM
"$pre" bight test forever.scm >out 2>&1 &
master=$!
await has_lines 1 process
kill -9 $master
wait $master 2>/dev/null
await gone "$(cat process)"
result $? 'with `bight test'"'"' killed, no scenario goes on'

# ---- Cases that go wrong ----

cat >bad.scm <<'SCM'
(define-study bad
  "What can happen to a case."
  #:for ((what 'fine 'raises 'breaks 'hangs 'murders 'quits))
  (in tank)
  (at-most 0.4)
  (fly (case what
         ((raises) (run -1))
         ((breaks) (kill (getpid) SIGABRT))
         ((hangs) (let loop () (loop)))
         ((murders) (unless (file-exists? "murdered")
                      (close-port (open-file "murdered" "w"))
                      (kill (getppid) SIGKILL)
                      (primitive-exit 9)))
         ((quits) (primitive-exit 7))))
  (measure (t (now))))
SCM
bight sweep bad.scm -o bad.db -j 2 >out 2>err
[ $? -eq 1 ] && grep -q 'bad.db: 6 cases: 2 done, 4 failed' out
result $? 'a case that goes wrong takes nothing with it, and the status says so'
grep -q '^bight: sweep: 4 cases failed; the first, case 2: bad.scm:[67]: run: ' err
result $? 'the first is told'
bight sweep --rows bad.db >bad.csv
grep -q '^2,failed,domain,"\{0,1\}bad.scm:[67]: run: ' bad.csv
result $? 'an error keeps its kind and its words'
grep -q '^3,failed,crash,.*signal 6,' bad.csv && grep -q '^6,failed,crash,.*status 7,' bad.csv
result $? 'so does a breakdown'
grep -q '^4,timed out,limit,.*(at-most 0.4) seconds' bad.csv
result $? 'a case that hangs is timed out'
grep -q '^5,done,' bad.csv
result $? 'the case of a worker that is killed is flown by another'
bight sweep bad.scm -o bad.db 2>&1 | grep -q '2 done, 4 failed (0 now)'
result $? 'what failed is not flown again'
bight sweep bad.scm -o bad.db --again 2>&1 | grep -q '2 done, 4 failed (4 now)'
result $? 'unless that is asked for'

# ---- Several cases in one process ----

sed 's/^  (latin-hypercube 3)/  (together 5) &/' quick.scm >together.scm
CASE_LOG=$scratch/together bight sweep together.scm -o together.db -j 2 >out 2>&1
[ "$(print_of together.db together.scm)" = "$one" ]
result $? 'five cases a process come to the same'
[ "$(wc -l <together)" -eq 12 ] && [ "$(sed 's/^(\([0-9]*\).*/\1/' together | sort -u | wc -l)" -eq 3 ]
result $? 'twelve in three processes'
bight sweep together.scm -o one.db | grep -q '12 done (0 now)'
result $? 'and it is the same study'
rm murdered
sed 's/(at-most 0.4)/& (together 3)/' bad.scm >bad-together.scm
bight sweep bad-together.scm -o bad-together.db -j 2 >out 2>err
bight sweep --rows bad-together.db | cut -d, -f 1-3 >rows
[ "$(tr '\n' ' ' <rows)" = \
  'number,status,error 1,done, 2,failed,domain 3,failed,crash 4,timed out,limit 5,done, 6,failed,crash ' ]
told=$?
result $told 'one that goes wrong takes none of its fellows with it'
[ $told -eq 0 ] || diag "$(cat out err rows)"
cat >long.scm <<'SCM'
(define-study long
  "Each takes its time."
  #:for ((case 1 2 3))
  (in tank)
  (together 3) (at-most 0.4)
  (fly (let ((end (+ (get-internal-run-time) (* 1/4 internal-time-units-per-second))))
         (let loop () (when (< (get-internal-run-time) end) (loop)))))
  (measure (t (now))))
SCM
bight sweep long.scm -j 1 | grep -q '3 cases: 3 done'
result $? 'and at-most is for each of them'

# ---- A study that changes ----

mkdir other
sed 's/0.2 0.8/0.2 0.9/' quick.scm >other/quick.scm
bight sweep other/quick.scm -o one.db 2>err
[ $? -eq 1 ] && grep -q 'the result holds 12 cases that the study does not ask for any more' err
result $? 'other cases are not mixed in'
sed 's/(run 0.25)/(run 0.5)/' quick.scm >other/quick.scm
bight sweep other/quick.scm -o one.db 2>err
[ $? -eq 1 ] && grep -q 'one.db. is the result of another text of the study (quick, bight' err
result $? 'nor is another text'
{ echo '; A remark.'; sed 's/seeds 2/seeds 3/; s/Twelve/Eighteen/' quick.scm; } >other/quick.scm
bight sweep other/quick.scm -o one.db 2>err | grep -q '18 cases: 18 done (6 now)'
result $? 'more seeds are flown beside those there are'
bight sweep --merge one.db quick.1-of-3.db 2>err
[ $? -eq 1 ] && grep -q 'quick.1-of-3.db. was flown for other cases of quick' err
result $? 'a shard of other cases is not merged'

# ---- On machines ----

# In place of ssh: the command in a shell of its own, here.
cat >run-here <<'SH'
#!/bin/sh
shift
exec sh -c "$*"
SH
chmod +x run-here
mkdir machines
cp quick.scm machines
(cd machines && BIGHT_SSH=$scratch/run-here BIGHT_SWEEP='-j 1' \
  "$pre" sh "$top_srcdir/studies/over-ssh.sh" quick.scm ann ben >out 2>err)
grep -q "quick.db: 12 cases: 12 done (12 now), fingerprint $one" machines/out
result $? 'two machines come to the same'
empty 'without a complaint' machines/err

mkdir array
cp quick.scm array
(cd array && for task in 1 2; do
   SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=2 \
     "$pre" sh "$top_srcdir/studies/slurm-array.sh" quick.scm 2 || echo failed
 done >out 2>&1
 "$pre" bight sweep --merge quick.db quick.*-of-2.db >>out 2>&1)
grep -q "12 done (12 now), fingerprint $one" array/out
result $? 'so do two tasks of a Slurm array'

if command -v parallel >/dev/null 2>&1 && parallel --version 2>/dev/null | grep -q GNU; then
  mkdir parallel
  cp quick.scm parallel
  (cd parallel && "$pre" parallel -j 2 bight sweep quick.scm -j 1 --shard '{}/2' ::: 1 2 >out 2>&1 </dev/null
   "$pre" bight sweep --merge quick.db quick.*-of-2.db >>out 2>&1)
  grep -q "12 done (12 now), fingerprint $one" parallel/out
  result $? 'so does GNU parallel'
else
  skip 'GNU parallel is not here'
fi
if ssh -o BatchMode=yes -o ConnectTimeout=2 localhost true >/dev/null 2>&1; then
  mkdir loop
  cp quick.scm loop
  # What is built is not on the path over there; the command comes by standard input, as it is.
  cat >remote <<SH
#!/bin/sh
printf '%s\\n' "\$2" | ssh -o BatchMode=yes "\$1" "'$pre' sh -s"
SH
  chmod +x remote
  (cd loop && BIGHT_SSH=$scratch/remote "$pre" sh "$top_srcdir/studies/over-ssh.sh" quick.scm localhost >out 2>&1)
  grep -q "12 done (12 now), fingerprint $one" loop/out
  result $? 'so does ssh, on loopback'
else
  skip 'no ssh to this machine'
fi

# ---- Tables and maps ----

bight sweep --table merged.db >out
grep -q '^  U  done  failed  slack .* east? *side$' out && grep -q '^  0 *6 *0 ' out
result $? 'a table groups what the study lists'
bight sweep --table merged.db --csv --by seed >out
head -1 out | grep -q '^seed,done,failed,slack_mean,slack_sd,slack_min,slack_max,east?,east?_low,east?_high,side$'
result $? 'as comma-separated values it has the intervals in columns'
bight sweep --map merged.db >out
grep -q '^ *U *dives *out *on$' out && grep -q '^0.3 *6 ' out
result $? 'a map has the legs across and the currents down'
if command -v gnuplot >/dev/null 2>&1; then
  bight sweep --map merged.db -o map.svg >out 2>err
  [ $? -eq 0 ] && grep -q '</svg>' map.svg && [ "$(grep -c '%' map.svg)" -ge 4 ]
  result $? 'and is drawn'
else
  bight sweep --map merged.db -o map.svg 2>err
  grep -q 'gnuplot' err
  result $? 'without gnuplot the map says what is missing'
fi

# ---- Mistakes ----

# refused NAME TEXT ARGUMENT...: the sweep fails with one line that has TEXT.
refused ()
{
  name=$1
  text=$2
  shift 2
  bight sweep "$@" >out 2>err
  status=$?
  if [ $status -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && grep -qF -e "$text" err; then
    result 0 "$name"
  else
    result 1 "$name"
    diag "$(cat err)"
  fi
}

echo '(+ 1 2)' >sum.scm
echo '(define-study (' >broken.scm
echo '(define-study s "One." (in tank) (mesure (t 1)))' >misspelt.scm
echo 'not a database, but long enough to be taken for one by its name alone' >text.db
: >empty.db
refused 'no study' 'name one study' -j 1
refused 'a missing file' 'there is no file "none.scm"' none.scm
refused 'a study by another name' 'did you mean `jacket-risk' jacket-rsk
refused 'a file without a study' '"sum.scm" defines no study' sum.scm
refused 'a file that ends too early' 'broken.scm' broken.scm
refused 'a misspelt clause' 'misspelt.scm:1: define-study: ' misspelt.scm
refused 'a result that cannot be' 'there is no folder "/none"' quick.scm -o /none/x.db
refused 'a result that is a folder' 'it is a folder' quick.scm -o machines
refused 'a result that is a text' '"text.db"' quick.scm -o text.db
BIGHT_LOGBOOK=$scratch/logbook.db bight -c '(log-dive!)' >/dev/null 2>&1
refused 'a result that is a logbook' '"logbook.db" is another kind of database' quick.scm -o logbook.db
refused 'a table of a logbook' '"logbook.db" is another kind of database' --table logbook.db
refused 'a table of nothing' '"empty.db" is empty' --table empty.db
refused 'a map without a study' 'there is no file "none.db"' --map none.db
refused 'a map of no legs' 'has no legs' --map bad.db
refused 'a map of a misspelt measure' 'did you mean `slack' --map merged.db --of slak
refused 'a map of a number' 'slack is not true or false' --map merged.db --of slack
refused 'a picture of another kind' 'SVG or PNG' --map merged.db -o map.jpg
refused 'groups by a misspelt variable' 'did you mean `push' --table merged.db --by U,pusch
refused 'no workers' '-j needs' quick.scm -j 0
refused 'a shard beyond the last' '--shard needs I/N' quick.scm --shard 4/3
refused 'two things at once' '--merge and --table are two things' --merge --table merged.db
refused 'a merge of nothing' 'say what goes into which' --merge merged.db
refused 'a shard of another study' 'another' --merge merged.db bad.db
finish
