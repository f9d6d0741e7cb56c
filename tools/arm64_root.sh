#!/usr/bin/env bash
# arm64_root.sh -- fills a folder with Debian's arm64 packages, for builds with cmake/toolchain-aarch64.cmake:
#
#     tools/arm64_root.sh FOLDER PACKAGE...
#
# Nothing of this machine's own packages is touched: apt gets lists and a status file of its own, and what it downloads is
# unpacked, not installed.
set -euo pipefail
mkdir -p "$1"
root=$(cd "$1" && pwd)
shift
mkdir -p "$root.apt"/{lists,archives}/partial "$root"/usr/{lib,bin,sbin}
touch "$root.apt/status"

arm64_apt() {
  apt-get -q -o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o Dir::State::lists="$root.apt/lists" \
    -o Dir::State::status="$root.apt/status" -o Dir::Cache="$root.apt" -o Dir::Cache::archives="$root.apt/archives" \
    -o Debug::NoLocking=1 "$@"
}
arm64_apt update
arm64_apt install -y --no-install-recommends --download-only "$@"

for folder in lib bin sbin; do
  ln -sfn "usr/$folder" "$root/$folder"
done
for package in "$root.apt"/archives/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar x --keep-directory-symlink --exclude='./usr/share/doc*' -C "$root" -f -
done

# Links and CMake's package files name places from the root folder on: from here they start at ours.
find "$root" -type l -lname '/*' | while read -r link; do
  target=$(readlink "$link")
  [[ $target == "$root"/* || ! -e $root$target ]] || ln -sfn "$root$target" "$link"
done
find "$root/usr/lib/aarch64-linux-gnu/cmake" -name '*.cmake' -print0 |
  xargs -0 sed -i -E "s#(^|[:;\" ])/usr/(lib/aarch64-linux-gnu|include)#\1$root/usr/\2#g"
