#!/usr/bin/env bash
# debian_root.sh -- runs a command in a root of some Debian, which debootstrap makes the first time (a minute, 300 MB):
#
#     tools/debian_root.sh SUITE COMMAND...          with these sources at /insonify, whose build/ is this tree's build/on/SUITE
#     tools/debian_root.sh --bare SUITE COMMAND...   in a root with Python, NumPy and pip alone, which is as new each time, with
#                                                    these sources at /insonify, read-only
#
# The root lies in build/roots. INSONIFY_MIRROR names another mirror than Debian's; ccache is used where CCACHE_DIR is set.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
kind='' packages=ca-certificates,git${CCACHE_DIR:+,ccache}
if [[ $1 == --bare ]]; then
  kind=bare- packages=python3,python3-numpy,python3-pip
  shift
fi
readonly suite=$1 root=build/roots/$kind$1
shift
((EUID == 0)) || { echo "Only root can make and enter a root of another Debian: run the same with sudo" >&2; exit 1; }

if [[ ! -d $root ]]; then
  rm -rf "$root.new"
  mkdir -p build/roots
  echo "Making $root, a Debian $suite"
  debootstrap --variant=minbase --include="$packages" "$suite" "$root.new" "${INSONIFY_MIRROR:-http://deb.debian.org/debian}" \
    >"$root.log" 2>&1 || { tail -n 5 "$root.log" >&2; echo "Failed: debootstrap; its whole output is in $root.log" >&2; exit 1; }
  mv "$root.new" "$root"
fi
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
mkdir -p "$root/insonify" "$root/ccache" "$root/data" "build/on/$suite"

# The mounts are in a namespace of their own, which ends with the command. Git takes sources that belong to somebody else.
exec unshare --mount bash -euo pipefail -c '
  root=$1 kind=$2 suite=$3 words=()
  shift 3
  if [[ $kind ]]; then  # What the command changes is in memory, and gone with it.
    mount -t tmpfs none build/on
    mkdir build/on/{above,work,root}
    mount -t overlay overlay -o "lowerdir=$root,upperdir=build/on/above,workdir=build/on/work" build/on/root
    root=build/on/root
  fi
  for folder in proc sys dev; do mount --rbind "/$folder" "$root/$folder"; done
  if [[ $kind ]]; then
    mount --rbind . "$root/insonify"
    mount -o remount,ro,bind "$root/insonify"
  else
    mount --bind . "$root/insonify"
    mount --bind "build/on/$suite" "$root/insonify/build"
  fi
  if [[ -n ${CCACHE_DIR:-} && -x $root/usr/bin/ccache ]]; then
    mount --bind "$CCACHE_DIR" "$root/ccache"
    mapfile -t words < <(env | grep -E "^CCACHE_" | grep -v -E "^CCACHE_(DIR|BASEDIR)=")
    words+=(CCACHE_DIR=/ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  if [[ -n ${INSONIFY_TEST_DATA:-} && ! $kind ]]; then
    mount --bind "$INSONIFY_TEST_DATA" "$root/data"
    words+=(INSONIFY_TEST_DATA=/data)
  fi
  exec chroot "$root" env -i HOME=/root TERM="${TERM:-dumb}" LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0="*" "${words[@]}" \
    bash -c "cd /insonify && exec \"\$@\"" bash "$@"
' bash "$root" "$kind" "$suite" "$@"
