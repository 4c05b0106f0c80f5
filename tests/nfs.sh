# Sweeps on a real NFS, with BIGHT_LONG=1 alone: two kernels of this test's own, User-mode Linux (Debian packages
# user-mode-linux, uml-utilities, nfs-kernel-server, kmod), of which `server' exports a file system and `client' mounts
# it, NFS 4.2 over a switch that no other program is on.  Processes are killed, the server's service ends and begins
# again, and the client is lost like a machine without power; what the sweeps come to is the same.
#
# Both kernels have this machine's files, which they cannot write, as their root; what they are to run and what that
# said goes through files of the scratch folder.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
if [ "${BIGHT_LONG:-}" != 1 ]; then
  skip 'two kernels for a real NFS take minutes: BIGHT_LONG=1'
  finish
fi
for tool in linux.uml uml_switch rpc.nfsd exportfs mount.nfs4 modprobe ip mkfs.ext4; do
  if ! command -v $tool >/dev/null || [ "$(id -u)" -ne 0 ]; then
    skip "a real NFS needs root, user-mode-linux, uml-utilities, nfs-kernel-server and kmod: there is no $tool"
    finish
  fi
done
. "$top_srcdir/tests/sweeps.sh"

# Half of the cases last as long as there is the file `hold'.
begin_study '(let loop () (when (and (> U 0) (file-exists? "hold")) (usleep 100000) (loop)))'

# ---- Two kernels ----

cat >init <<SH
#!/bin/bash
export PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/run TMPDIR=/run/tmp LC_ALL=C.UTF-8
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mount -t tmpfs tmpfs /run
mount -t tmpfs tmpfs /var/lib/nfs
mkdir -p /run/tmp /run/modules/lib /run/talk
ln -s /usr/lib/uml/modules /run/modules/lib/modules
mount -t hostfs none /run/talk -o "$scratch"
role=\$(sed 's/.*role=\([a-z]*\).*/\1/' /proc/cmdline)
hostname "\$role" # by which NFS tells clients apart
modprobe -d /run/modules nfsv4
modprobe -d /run/modules nfsd
ip link set lo up
ip link set eth0 up
ip address add "\$(sed 's/.*address=\([0-9.]*\).*/\1/' /proc/cmdline)/24" dev eth0
cd /run
BIGHT_PATIENCE=1000000
. "$top_srcdir/tests/tap.sh"
n=1
while await [ -e "talk/\$role.\$n" ]; do
  (bash "talk/\$role.\$n" >"talk/\$role.\$n.out" 2>&1 </dev/null
  echo \$? >"talk/\$role.\$n.part" && mv "talk/\$role.\$n.part" "talk/\$role.\$n.status") &
  n=\$((n + 1))
done
SH
chmod +x init
switch="$scratch/switch"
uml_switch -unix "$switch" >switch.log 2>&1 </dev/null &
switch_process=$!
kernels=
boot () # ROLE ADDRESS [OPTION]
{
  setsid linux.uml mem=512M root=/dev/root rootfstype=hostfs rootflags=/ ro con=null con0=null,fd:1 \
    eth0=daemon,,unix,"$switch" "umid=bight-$1-$$" uml_dir="$scratch/" init="$scratch/init" \
    "role=$1" "address=$2" ${3:-} >"$1.console" 2>&1 </dev/null &
  eval "kernel_$1=$!"
  kernels="$kernels $!"
}
lose () # KERNEL: with all the processes that it is made of
{
  kill -9 "-$1" 2>/dev/null
  await gone "$1"
}
end_kernels ()
{
  itself || return
  for kernel in $kernels; do
    lose "$kernel"
  done
  kill $switch_process 2>/dev/null
  rm -rf "$scratch"
}
trap end_kernels EXIT

orders_server=0
orders_client=0
# begin ROLE COMMAND: it begins there, as the order number that is `order' then.
begin ()
{
  order=$((orders_$1 + 1))
  eval "orders_$1=$order"
  printf '%s\n' "$2" >"$1.new" && mv "$1.new" "$1.$order"
}
# ended ROLE NUMBER: that order has ended; its status, and its output as `out'.
ended ()
{
  await [ -e "$1.$2.status" ] || return 99
  cp "$1.$2.out" out
  return "$(cat "$1.$2.status")"
}
on () # ROLE COMMAND: it is done there
{
  begin "$1" "$2"
  ended "$1" "$order"
}
sweep="cd /mnt && $pre bight sweep"

truncate -s 256M disk
mkfs.ext4 -q disk
boot server 10.0.9.1 "ubd0=$scratch/disk"
boot client 10.0.9.2
on server 'set -e
mount /dev/ubda /srv
mount -t nfsd nfsd /proc/fs/nfsd
mkdir -p /var/lib/nfs/v4recovery
touch /var/lib/nfs/etab /var/lib/nfs/rmtab
echo 60 >/proc/fs/nfsd/nfsv4leasetime
echo 10 >/proc/fs/nfsd/nfsv4gracetime
rpcbind -w || rpcbind
rpc.mountd
rpc.nfsd -N 3 4
exportfs -o rw,no_root_squash,fsid=0,insecure,no_subtree_check "*:/srv"
mount -t nfs4 -o actimeo=1 127.0.0.1:/ /mnt'
served=$?
result $served 'a kernel of its own exports a file system'
[ $served -eq 0 ] || diag "$(cat out server.console)"
on client 'mount -t nfs4 -o actimeo=1 10.0.9.1:/ /mnt && stat -f -c %T /mnt && grep " /mnt nfs4" /proc/mounts'
grep -qx nfs out
mounted=$?
result $mounted 'another kernel mounts it'
diag "$(cat out)"
[ $mounted -eq 0 ] || { diag "$(cat client.console)"; finish; }

# ---- A sweep there ----

# swept ROLE NUMBER NOW NAME: that order was a sweep that came to the same, NOW of its twelve cases flown by it.
swept ()
{
  ended "$1" "$2"
  grep -q "12 done ($3 now), fingerprint $one\$" out
  swept_status=$?
  result $swept_status "$4"
  [ $swept_status -eq 0 ] || diag "$(cat out)"
}
on server "cp /run/talk/quick.scm /mnt"
begin client "$sweep quick.scm -o one.db"
swept client $order 12 'a sweep on NFS comes to the same'

# half ROLE RESULT: a sweep that holds after six cases is under way there, as the order `holding'.
half ()
{
  begin "$1" "touch /mnt/hold; $sweep quick.scm -o $2 -j 1"
  holding=$order
  await six_seen "$2"
}
six_seen ()
{
  on server "$sweep --rows $1" && [ "$(grep -c ',done,' out)" -eq 6 ]
}
half client held.db
result $? 'what is done can be seen from another host meanwhile'
on server "$sweep quick.scm -o held.db"
[ $? -eq 1 ] && grep -q 'another sweep is writing "held.db"' out
refused=$?
result $refused 'another host is refused'
[ $refused -eq 0 ] || diag "$(cat out client.console server.console)"
on client 'kill -9 $(pgrep -o -f "sweep quick.scm -o held.db")'
ended client $holding
on server 'rm /mnt/hold'
begin server "$sweep quick.scm -o held.db"
swept server $order 6 'and goes on when that sweep is killed'

# ---- Shards on both ----

begin server "$sweep quick.scm --shard 1/2"
first=$order
on client "$sweep quick.scm --shard 2/2"
ended server $first
begin server "$sweep --merge merged.db quick.1-of-2.db quick.2-of-2.db"
swept server $order 12 'shards of two hosts are merged'

# ---- The service ends, and begins again ----

half client again.db
on server 'rpc.nfsd 0 && rpc.nfsd -N 3 4 && rm /srv/hold'
swept client $holding 12 'a server that begins again loses nothing of a sweep'

# ---- A host without power ----

half client lost.db
lose "$kernel_client"
result $? 'a host is lost'
on server 'rm /mnt/hold'
begin server "$sweep quick.scm -o lost.db --patience $patience"
swept server $order 6 'what a lost host had done is there, and another goes on'
on server 'ls -A /srv'
grep -E 'nfs[0-9a-f]{8}|-wal$|-shm$|-journal$' out >left
empty 'nothing is left beside the results' left
finish
