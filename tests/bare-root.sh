#!/bin/sh
# README's two commands on a bare Debian: tests/bare-root.sh RELEASE [run | check | shell].
#
# Debootstrap makes a root of RELEASE, such as trixie, in $BARE_ROOTS (/var/tmp/bight-roots) unless there is one:
# the smallest set of packages, sudo, and a user `newcomer' who may use it.  What is committed here is cloned into
# that user's home, anew each time.  The user then types README's first screen at `./bootstrap run', where the
# misspelt keyword must be answered, and `./bootstrap check'.  `run' and `check' do one of the two; `shell' opens
# a shell there instead.
#
# It needs root, debootstrap, git and unshare (util-linux).  Mounts and processes live in namespaces of their own
# and go with them; the root folder stays, packages and all, until it is deleted.  BARE_MIRROR names a mirror.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

set -eu

top=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
mirror=${BARE_MIRROR:-http://deb.debian.org/debian}
roots=${BARE_ROOTS:-/var/tmp/bight-roots}

die ()
{
  printf 'bare-root.sh: %s\n' "$*" >&2
  exit 1
}

# make_root RELEASE FOLDER: whole, or not at all.
make_root ()
{
  script=/usr/share/debootstrap/scripts/$1
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid # of a release younger than debootstrap
  rm -rf "$2.part"
  debootstrap --variant=minbase --include=sudo "$1" "$2.part" "$mirror" "$script"
  cp /etc/resolv.conf /etc/hosts "$2.part/etc/"
  echo 'newcomer ALL=(ALL) NOPASSWD: ALL' >"$2.part/etc/sudoers.d/newcomer"
  chroot "$2.part" useradd --create-home --shell /bin/bash newcomer
  mv "$2.part" "$2"
}

# newcomer COMMAND: the user's shell runs it in the clone.
newcomer ()
{
  chroot "$root" su -l newcomer -c "cd bight && $1"
}

run ()
{
  home=$root/home/newcomer
  printf '%s\n' "(enter! 'open-water)" '(look)' '(drive! #:surge 1 #:yow 0.1)' >"$home/typed"
  newcomer './bootstrap run <../typed >../said 2>&1' || : # a script with a mistake in it fails
  cat "$home/said"
  grep -qF "did you mean \`#:yaw'" "$home/said"
}

# What is skipped is told: a test that never runs fails nowhere.
check ()
{
  status=0
  newcomer './bootstrap check' || status=$?
  grep -rhE '^SKIP: [^ ]+ .' --include='*.log' "$root/home/newcomer/bight/build/tests" | sort -u
  return $status
}

# inside RELEASE WHAT: in namespaces of its own.
inside ()
{
  root=$roots/$1
  mkdir -p "$roots"
  [ -d "$root" ] || make_root "$1" "$root"
  rm -rf "$root/home/newcomer/bight"
  git clone --quiet --no-hardlinks "$top" "$root/home/newcomer/bight"
  chroot "$root" chown -R newcomer:newcomer /home/newcomer
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount -t tmpfs -o mode=1777 tmpfs "$root/tmp"
  case $2 in
    run | check) "$2" ;;
    both) run && check ;;
    shell) chroot "$root" su -l newcomer ;;
  esac
}

if [ "${1:-}" = --inside ]; then
  inside "$2" "$3"
  exit
fi

release=${1:-}
what=${2:-both}
case $release in
  '' | -* | */*)
    sed -n '2,/^# Copyright/{/^# Copyright/d; s/^# \{0,1\}//p}' "$0" >&2
    exit 2
    ;;
esac
case $what in
  run | check | shell | both) ;;
  *) die "$what is none of run, check, shell" ;;
esac
[ "$(id -u)" -eq 0 ] || die 'only root can make a root folder: sudo tests/bare-root.sh ...'
for tool in debootstrap git unshare; do
  command -v $tool >/dev/null || die "there is no $tool"
done
exec unshare --mount --pid --fork --kill-child "$0" --inside "$release" "$what"
