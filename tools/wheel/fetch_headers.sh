#!/usr/bin/env bash
# fetch_headers.sh -- unpacks headers of a Python, and of a pybind11 that knows it, from the packages of a Debian that has them:
#
#     tools/wheel/fetch_headers.sh FOLDER SUITE VERSION     e.g. build/wheel/headers trixie 3.13
#
# They are in FOLDER/usr/include then. A module is not linked with Python, so its headers are all that it takes to build one.
# Nothing of this machine's own packages is touched, as in tools/arm64_root.sh.
set -euo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
readonly folder suite=$2 version=$3
readonly apt=$folder/apt-$suite
mkdir -p "$apt"/lists/partial "$apt"/packages
touch "$apt/status"
cat >"$apt/sources.list" <<END
deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] ${INSONIFY_MIRROR:-http://deb.debian.org/debian} $suite main
END
readonly options=(-q -o Dir::Etc::sourcelist="$apt/sources.list" -o Dir::Etc::sourceparts=/dev/null -o Dir::State::lists="$apt/lists"
  -o Dir::State::status="$apt/status" -o Dir::Cache="$apt" -o Dir::Etc::preferencesparts=/dev/null -o APT::Sandbox::User=root
  -o Debug::NoLocking=1)
apt-get "${options[@]}" update
cd "$apt/packages"
apt-get "${options[@]}" download "libpython$version-dev" pybind11-dev
for package in *.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar x --wildcards -C "$folder" -f - './usr/include/*'
done
