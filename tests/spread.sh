# Sweeps on the machines and engines that people have: network folders, GNU parallel, Slurm, kernels short of memory.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/sweeps.sh"

begin_study

# ---- Ended from outside ----

# A case ends itself by SIGNAL as long as the file `ends' has fewer lines than ENDS.
cat >ended.scm <<'SCM'
(define (line! file . words)
  (let ((port (open-file file "a")))
    (write words port)
    (newline port)
    (close-port port)))
(define (lines file)
  (if (file-exists? file)
      (string-count (call-with-input-file file (@ (ice-9 textual-ports) get-string-all)) #\newline)
      0))
(define-study ended
  "The third of six is ended from outside."
  #:for ((n (range 1 6 1)))
  (in tank)
  (fly (line! "order" n)
       (when (and (= n 3) (< (lines "ends") (string->number (getenv "ENDS"))))
         (line! "ends" n)
         (false-if-exception (sigaction (string->number (getenv "SIGNAL")) SIG_DFL)) ; whoever began this may ignore it, as nohup does
         (kill (getpid) (string->number (getenv "SIGNAL")))
         (let loop () (loop))))
  (measure (twice (* 2 n))))
SCM
ENDS=0 SIGNAL=9 bight sweep ended.scm -o never.db >out 2>err
never=$(sed -n 's/.*6 done (6 now), fingerprint //p' out)
for signal in 9 15 1; do
  rm -f ends order
  ENDS=2 SIGNAL=$signal bight sweep ended.scm -j 2 -o ended.$signal.db >out 2>err
  [ $? -eq 0 ] && grep -q "6 done (6 now), fingerprint $never" out
  result $? "a case that signal $signal ended twice is flown a third time, and comes to the same"
  [ "$(grep -c "^bight: sweep: case 3: .*from outside, by signal $signal.*; it is flown again, by itself\$" err)" -eq 2 ]
  result $? 'that is told each time'
  [ "$(tail -n 2 order | sort -u)" = '(3)' ] && [ "$(wc -l <order)" -eq 8 ]
  result $? 'after all others, by itself, and no other is flown again'
done
rm -f ends order
ENDS=3 SIGNAL=9 bight sweep ended.scm -j 2 -o more.db >out 2>err
[ $? -eq 1 ] && grep -q '5 done, 1 failed' out && grep -q 'case 3: .*3 times, at last flown by itself' err
result $? 'at the third end it counts as failed'
bight sweep --rows more.db | grep -q '^3,failed,interrupted,'
result $? 'as interrupted'
ENDS=3 SIGNAL=9 bight sweep ended.scm -o more.db >out 2>err
grep -q "6 done (1 now), fingerprint $never" out
result $? 'and the next sweep flies it again'
rm -f ends order
ENDS=1 SIGNAL=11 bight sweep ended.scm -o broken.db >out 2>err
[ $? -eq 1 ] && bight sweep --rows broken.db | grep -q '^3,failed,crash,.*signal 11' && [ "$(wc -l <ends)" -eq 1 ]
result $? 'a breakdown of its own is an outcome, and flown once'

# ---- The type of a measure ----

cat >kinds.scm <<'SCM'
(define-study kinds
  "What is 0 or 1 by chance, and what is true or false."
  #:for ((n 0 1 2 3))
  (in tank)
  (leg out (run 0.1))
  (measure (count (min n (string->number (getenv "MOST"))))
           (yes? (> n (string->number (getenv "MOST"))))
           (always? #t)))
SCM
head_of () # RESULT: the first line of its table
{
  bight sweep --table "$1" --csv --by n | head -n 1
}
for most in 0 1 3; do
  MOST=$most bight sweep kinds.scm -o kinds.$most.db >kinds.$most.out 2>&1
  head_of kinds.$most.db >head.$most
done
expected='n,done,failed,count_mean,count_sd,count_min,count_max,yes?,yes?_low,yes?_high,always?,always?_low,always?_high'
[ "$(cat head.0)" = "$expected" ] && cmp -s head.0 head.1 && cmp -s head.0 head.3
result $? 'a number that is 0 or 1 in all cases stays a number, and the columns stay'
grep -q '^count  *4  *0 +- 0 (0 to 0)$' kinds.0.out && grep -q '^yes?  *true  *0 of 4 ' kinds.3.out
result $? 'in the summary too'
bight sweep --map kinds.0.db --of count 2>&1 | grep -q 'count is not true or false'
result $? 'and it is no probability to map'
for part in 1 2; do
  MOST=1 bight sweep kinds.scm --shard $part/2 >>out 2>&1
done
bight sweep --merge kinds.merged.db kinds.?-of-2.db >out && [ "$(head_of kinds.merged.db)" = "$expected" ]
result $? 'merged shards know it as well'

# ---- A network folder ----

if [ "$sanitize" = yes ] || ! ${CC:-cc} -shared -fPIC -o locks.so "$top_srcdir/tests/network_locks.c" -ldl 2>err; then
  skip 'a network folder cannot be made here'
else
  printf '#!/bin/sh\nLD_PRELOAD=%s/locks.so exec "$@"\n' "$scratch" >networked
  chmod +x networked
  "$pre" ./networked bight sweep quick.scm -j 2 -o net.db >out 2>err
  [ $? -eq 0 ] && grep -q "12 done (12 now), fingerprint $one" out
  net=$?
  result $net 'where flock and the locks of SQLite are the same, and no memory is shared, a sweep is flown'
  [ $net -eq 0 ] || diag "$(cat err)"
  "$pre" ./networked bight sweep --table net.db >out 2>err && [ -s out ]
  result $? 'and looked at'
  "$pre" ./networked bight sweep --merge netted.db net.db 2>err | grep -q "12 done (12 now), fingerprint $one"
  result $? 'and merged'
fi

# ---- While it is being written ----

cat >held.scm <<'SCM'
(define-study held
  "The last case waits for the file `go'."
  #:for ((n (range 1 6 1)))
  (in tank)
  (fly (when (= n 6)
         (close-port (open-file "waiting" "w"))
         (let loop () (unless (file-exists? "go") (usleep 10000) (loop)))))
  (measure (twice (* 2 n))))
SCM
"$pre" bight sweep held.scm -j 1 >held.out 2>&1 &
holder=$!
await test -e waiting
bight sweep --rows held.db >rows 2>err
[ "$(grep -c ',done,' rows)" -eq 5 ]
seen=$?
result $seen 'a result that is being written can be looked at: the five cases there are'
[ $seen -eq 0 ] || diag "$(cat err)"
bight sweep --merge looked.db held.db | grep -q '5 done, 1 missing (5 now)'
result $? 'and merged as it is'
bight sweep held.scm -o held.db 2>err
[ $? -eq 1 ] && grep -q 'another sweep is writing "held.db"' err
result $? 'but not written by two'
touch go
wait $holder
[ $? -eq 0 ] && grep -q '6 done (6 now)' held.out
result $? 'whoever writes it is not disturbed'

# ---- A Slurm array, task by task ----

task () # NUMBER COUNT [N]: what Slurm does for one task of a submission that has COUNT
{
  (cd array && SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_COUNT=$2 SLURM_ARRAY_TASK_MIN=$1 \
    "$pre" sh "$top_srcdir/studies/slurm-array.sh" quick.scm ${3:-} 2>&1)
}
mkdir array
cp quick.scm array
for i in 1 2 3 4; do
  [ $i -eq 3 ] || task $i 4 4 >>out
done
task 3 1 4 >out
[ $? -eq 0 ] && grep -q '^quick.3-of-4.db: 3 cases: 3 done' out
result $? 'a task that failed is submitted again by itself'
{ task 1 2 4; task 3 2 4; } >out
[ "$(grep -c '3 done (0 now)' out)" -eq 2 ]
result $? 'two tasks submitted again are of the same sweep'
bight sweep --merge array/quick.db array/quick.*-of-4.db | grep -q "12 done (12 now), fingerprint $one"
result $? 'the parts merge to the same'
task 2 1 >out
grep -q '^quick.2-of-16.db' out
result $? 'without a number the parts are the sixteen that the script asks Slurm for'
! sh "$top_srcdir/studies/slurm-array.sh" quick.scm >/dev/null 2>err && grep -q '^usage: sbatch' err
result $? 'outside Slurm it says how it is used'

# ---- The line for GNU parallel, and over ssh ----

# In place of ssh: options and the machine dropped, the command in a shell of its own.
mkdir bin
cat >bin/ssh <<'SH'
#!/bin/sh
while :; do
  case $1 in
    -[lopS]) shift 2 ;;
    -*) shift ;;
    *) break ;;
  esac
done
shift
[ "${1:-}" != -- ] || shift
exec sh -c "$*"
SH
chmod +x bin/ssh
PATH=$scratch/bin:$PATH
# What GNU parallel takes for granted, as every login sets it.
HOME=$scratch/home
SHELL=/bin/sh
export PATH HOME SHELL
mkdir -p "$HOME"

sed -n '/^#   parallel /,/^#   bight sweep --merge/s/^#   //p' "$top_srcdir/studies/over-ssh.sh" \
  | sed 's/STUDY/quick/g' >line
[ "$(wc -l <line)" -eq 3 ] && sed -n '/^parallel /,/^bight sweep --merge/p' "$top_srcdir/doc/sweep.texi" \
  | sed 's/STUDY/quick/g' | cmp -s - line
result $? 'the script and the manual show the same line for GNU parallel'
if command -v rsync >/dev/null 2>&1 && parallel --version 2>/dev/null | grep -q GNU; then
  mkdir shared
  cp quick.scm shared
  (cd shared && "$pre" sh ../line >out 2>&1 </dev/null)
  grep -q "12 done (12 now), fingerprint $one" shared/out
  parallel=$?
  result $parallel 'on a shared folder it flies all'
  [ $parallel -eq 0 ] || diag "$(cat shared/out)"
  [ "$(ls shared/quick.*-of-12.db | wc -l)" -eq 12 ]
  result $? 'and deletes no result'
  rm shared/quick.5-of-12.db shared/quick.db
  (cd shared && "$pre" sh ../line >out 2>&1 </dev/null)
  grep -q "12 done (12 now), fingerprint $one" shared/out && [ "$(grep -c '1 done (0 now)' shared/out)" -eq 11 ]
  result $? 'again, it flies what is missing alone'
else
  skip 'GNU parallel or rsync is not here'
fi

# A machine with a folder of its own, /.../far in place of here, from which a first, incomplete result was fetched.
mkdir -p far near
cp quick.scm far
cp quick.scm near
cat >to-far <<SH
#!/bin/sh
shift
exec sh -c "\$(printf '%s' "\$*" | sed 's,$scratch/near,$scratch/far,g')"
SH
printf '#!/bin/sh\nexec cp "%s/far/${1##*/}" "$2"\n' "$scratch" >from-far
chmod +x to-far from-far
(cd near && "$pre" bight sweep quick.scm --shard 2/2 -o quick.1-of-1.db >/dev/null 2>&1
 BIGHT_SSH=$scratch/to-far BIGHT_SCP=$scratch/from-far \
   "$pre" sh "$top_srcdir/studies/over-ssh.sh" quick.scm ann >out 2>&1)
grep -q "12 done (12 now), fingerprint $one" near/out
result $? 'an older shard that lies here does not stand in the way of what a machine has done since'
finish
