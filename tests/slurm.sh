# Sweeps under Slurm: an array and the job that merges, followed, submitted again, killed.
#
# By default Slurm is two programs of this test, which do what those of Slurm are asked for here.  With BIGHT_LONG=1
# it is a real one, of this test alone: its controller and two nodes on this machine (Debian packages slurm-wlm and
# munge), of which cases, tasks and a node are killed.
#
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/sweeps.sh"

# A case notes its process; it lasts as long as there is the file `hold'.
begin_study '(let ((port (open-file "flown" "a")))
         (write (list (getpid) (getenv "SLURM_ARRAY_TASK_ID") (getenv "SLURMD_NODENAME")) port)
         (newline port)
         (close-port port))
       (let loop () (when (file-exists? "hold") (usleep 20000) (loop)))'
rm -f flown
bight sweep quick.scm --slurm --tasks 0 2>err
grep -q -- '--tasks needs' err
result $? 'no tasks are refused'

# ---- Slurm ----

if [ "${BIGHT_LONG:-}" != 1 ]; then
  mkdir bin jobs queue
  cat >bin/sbatch <<SH
#!/bin/sh
cd "$scratch"
job=\$((\$(ls jobs/*.words 2>/dev/null | wc -l) + 1))
array=
after=
output=/dev/null
for word; do
  case \$word in
    --array=*) array=\${word#*=} ;;
    --dependency=afterany:*) after=\${word#*:} ;;
    --output=*) output=\${word#*=} ;;
    --unknown) echo 'sbatch: error: that is no option' >&2; exit 1 ;;
    --*) ;;
    *) cp "\$word" jobs/\$job ;;
  esac
done
printf '%s ' "\$@" >jobs/\$job.words
mkdir queue/\$job
tasks=\$(printf '%s' "\$array" | tr , '\\n' | while IFS=- read -r a b || [ -n "\$a" ]; do seq "\$a" "\${b:-\$a}"; done)
exec 9>jobs/\$job.lock
flock 9
(
  [ -z "\$after" ] || flock jobs/\$after.lock true # until that job is over
  for task in \${tasks:-none}; do
    [ -e queue/\$job ] || exit 0
    SLURM_ARRAY_TASK_ID=\$task SLURM_CPUS_PER_TASK=1 sh jobs/\$job \\
      >>"\$(printf '%s' "\$output" | sed "s/%a/\$task/")" 2>&1
  done
  rmdir queue/\$job
) >/dev/null 2>&1 </dev/null &
echo \$job
SH
  cat >bin/squeue <<SH
#!/bin/sh
for job in \$(ls "$scratch/queue"); do echo "\$job RUNNING"; done
SH
  chmod +x bin/sbatch bin/squeue
  PATH=$scratch/bin:$PATH
  export PATH
elif ! command -v slurmctld >/dev/null || ! command -v munged >/dev/null || [ "$(id -u)" -ne 0 ]; then
  skip 'a real Slurm needs slurm-wlm, munge and root'
  finish
else
  real=$scratch/real
  mkdir -m 755 "$real" "$real/state" "$real/spool.n1" "$real/spool.n2"
  mkdir -m 700 "$real/munge"
  head -c 1024 /dev/urandom >"$real/munge/key"
  chmod 400 "$real/munge/key"
  chmod 755 "$scratch"
  port=$((20000 + $$ % 10000))
  cat >"$real/slurm.conf" <<CONF
ClusterName=bight
SlurmctldHost=localhost
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$real/munge/socket,cred_expire=5
SlurmctldPort=$port
SlurmctldPidFile=$real/slurmctld.pid
SlurmdPidFile=$real/slurmd.%n.pid
SlurmdSpoolDir=$real/spool.%n
StateSaveLocation=$real/state
SlurmctldLogFile=$real/slurmctld.log
SlurmdLogFile=$real/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
SchedulerParameters=bf_interval=5,sched_interval=5
NodeName=n1 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 State=UNKNOWN
NodeName=n2 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
  SLURM_CONF=$real/slurm.conf
  export SLURM_CONF
  end_slurm ()
  {
    itself || return
    scancel --user=root >/dev/null 2>&1
    daemons=$(cat "$real/slurmd.n1.pid" "$real/slurmd.n2.pid" "$real/slurmctld.pid" "$real/munge/pid" 2>/dev/null)
    # shellcheck disable=SC2086 # a list of processes
    { kill $daemons && await gone $daemons; } 2>/dev/null
    rm -rf "$scratch"
  }
  trap end_slurm EXIT
  munged --force --key-file="$real/munge/key" --socket="$real/munge/socket" --pid-file="$real/munge/pid" \
    --log-file="$real/munge/log" --seed-file="$real/munge/seed" >out 2>&1
  slurmctld >>out 2>&1
  slurmd -N n1 >>out 2>&1
  slurmd -N n2 >>out 2>&1
  both_idle ()
  {
    [ "$(sinfo -h -N -t idle -o %N | sort -u | wc -l)" -eq 2 ]
  }
  await both_idle
  result $? 'a controller and two nodes are there'
fi

# ---- A sweep, followed to its end ----

bight sweep quick.scm --slurm --tasks 3 >out 2>err
status=$?
[ $status -eq 0 ] && grep -q "^quick.db: 12 cases: 12 done ([0-9]* now), fingerprint $one\$" out
swept=$?
result $swept 'Slurm flies a study, and it comes to the same'
[ $swept -eq 0 ] || diag "$(cat out err *.log)"
grep -q 'fly parts 1-3 of 3' out && [ "$(ls quick.?-of-3.db | wc -l)" -eq 3 ]
result $? 'in as many parts as were asked for'
grep -q "12 done (12 now), fingerprint $one" quick.merge.log
result $? 'the job that came after the array has put them together'
[ "$(wc -l <flown)" -eq 12 ]
result $? 'and no case was flown twice'

# ---- Again ----

bight sweep quick.scm --slurm >out 2>err
[ $? -eq 0 ] && ! grep -q ' fly part' out && grep -q "12 done (0 now), fingerprint $one" out
result $? 'again, nothing is submitted'
rm quick.2-of-3.db
bight sweep quick.scm --slurm >out 2>err
[ $? -eq 0 ] && grep -q 'fly part 2 of 3' out && grep -q "12 done (0 now), fingerprint $one" out
result $? 'a part that is lost is submitted by itself'
[ "$(wc -l <flown)" -eq 16 ]
result $? 'and flown alone'
bight sweep quick.scm --slurm --tasks 5 2>err
[ $? -eq 1 ] && grep -q '"quick.db" is being flown in 3 parts' err
result $? 'another number of parts does not begin another sweep'

# ---- Detached, and looked at twice ----

touch hold
bight sweep quick.scm --slurm --tasks 4 -o "it's.db" --detach >out 2>err
[ $? -eq 0 ] && grep -q "^it's.db: jobs" out
result $? 'detached, it waits for nothing'
bight sweep quick.scm --slurm -o "it's.db" --detach >out 2>err
[ $? -eq 0 ] && grep -q 'are under way' out
result $? 'what is under way is not submitted again'
bight sweep quick.scm --slurm --tasks 5 -o "it's.db" --detach 2>err
[ $? -eq 1 ] && grep -q 'is being flown in 4 parts' err
result $? 'and keeps its parts, be there files of them or not'
"$pre" bight sweep quick.scm --slurm -o "it's.db" >followed 2>err &
follower=$!
await grep -q 'are under way' followed # a file of its own: `out' has said so already
kill -INT $follower
wait $follower
[ $? -eq 1 ] && grep -q 'go on without us' err
result $? '^C leaves the jobs alone, and says so'
rm hold
bight sweep quick.scm --slurm -o "it's.db" >out 2>err
[ $? -eq 0 ] && grep -q "12 done ([0-9]* now), fingerprint $one" out
result $? 'followed again it comes to its end'

# ---- What goes wrong ----

bight sweep quick.scm --slurm -o bad.db --sbatch '--unknown' 2>err
[ $? -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && grep -q '^bight: .*sbatch: ' err
result $? 'what sbatch refuses is told'
[ ! -e bad.slurm ]
result $? 'and noted nowhere'
for text in '((parts . 2) (jobs "1; touch stolen"))' '((parts . #1@0(1)) (jobs))' '(((((' ''; do
  printf '%s' "$text" >bad.slurm
  bight sweep quick.scm --slurm -o bad.db 2>err
  [ $? -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && grep -q 'is not what a sweep notes of its jobs' err && [ ! -e stolen ]
  result $? "a forged note is refused: $text"
done
printf '#!/bin/sh\nexec env PATH="%s" bight "$@"\n' "$top_builddir/src/bin:$scratch/few" >without
mkdir few
for tool in sh env sed dirname basename cat test; do
  ln -s "$(command -v $tool)" few/$tool 2>/dev/null
done
"$pre" sh without sweep quick.scm --slurm -o bare.db 2>err
[ $? -eq 1 ] && grep -q 'there is no program sbatch here: --slurm needs Slurm' err
result $? 'without Slurm it says what is missing'
echo '(define-study sorry "It cannot." #:for ((n 1 2)) (in tank) (fly (when (= n 2) (run -1))) (measure (t (now))))' >sorry.scm
bight sweep sorry.scm --slurm --tasks 2 >out 2>err
[ $? -eq 1 ] && grep -q '2 cases: 1 done, 1 failed' out && grep -q '1 case failed; the first, case 2: sorry.scm:1: run: ' err
result $? 'a case that goes wrong is told at the end, with its place'

# ---- Killed ----

if [ "${BIGHT_LONG:-}" = 1 ]; then
  rm -f flown
  touch hold
  bight sweep quick.scm --slurm --tasks 4 -o killed.db --detach >out 2>err
  await has_lines 4 flown
  result $? 'four tasks fly on two nodes'
  process_of () # TASK: the process of the case that it flies
  {
    sed -n "s/^(\\([0-9]*\\) \"$1\" .*/\\1/p" flown | tail -n 1
  }
  parent () # PROCESS
  {
    ps -o ppid= -p "$1" | tr -d ' '
  }
  kill -9 "$(process_of 1)"
  # A task, Slurm's process and all that it runs: the master of the sweep is the parent of a case's worker.
  master=$(parent "$(parent "$(process_of 2)")")
  kill -9 "$master"
  await gone "$(process_of 2)"
  result $? 'with its master, what a task flew is gone'
  kill -9 "$(cat "$real/slurmd.n2.pid")"
  node_down ()
  {
    sinfo -h -N -n n2 -o %T | grep -q down
  }
  await node_down
  result $? 'a node is lost'
  slurmd -N n2 >>out 2>&1
  moment 30
  rm hold
  settled ()
  {
    [ -z "$(squeue -h)" ]
  }
  await settled
  result $? 'the jobs come to an end'
  diag "$(grep -h . killed.merge.log)"
  bight sweep quick.scm --slurm -o killed.db >out 2>err
  status=$?
  [ $status -eq 0 ] && grep -q "12 done ([0-9]* now), fingerprint $one" out
  survived=$?
  result $survived 'the same command flies what is missing, and it comes to the same'
  diag "$(cat out err) flights: $(wc -l <flown)"
  [ $survived -eq 0 ] || diag "$(cat killed*.log)"
fi
finish
