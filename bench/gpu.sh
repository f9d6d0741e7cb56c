#!/usr/bin/env bash
# gpu.sh -- engine gpu on a machine with a graphics card: its tests, and its times into gpu.json and gpu.txt beside this file.
#
#   bench/gpu.sh                  here, with the build in build/release (cmake --build --preset release)
#   bench/gpu.sh --pack FILE      an archive for a machine that has a card and its driver but neither compiler nor packages:
#                                 carry FILE there, then  tar xf FILE && ./gpu/gpu.sh
#
# The archive brings the program, the tests, every library that they need, and Vulkan's loader, which images with a driver
# often lack. Both machines need the same processor architecture, and the other one a C library as new as this one's.
# Triangles of the scenes: INSONIFY_GPU_TRIANGLES="1000 100000 1000000 10000000"; card: INSONIFY_DEVICE, its index or a
# part of its name [0].
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# Libraries that every Linux has, and that must be the machine's own.
readonly own='/(ld-linux[^/]*|libc|libm|libdl|librt|libpthread|libresolv|libgcc_s|libstdc\+\+)\.so'

pack() {
  local archive=$1 build=$here/../build/release
  root=$(mktemp -d)  # Not local: it goes when the script ends.
  trap 'rm -rf "$root"' EXIT
  mkdir -p "$root/gpu/lib"
  cp "$here/gpu.sh" "$root/gpu/"
  cp "$build/insonify" "$build/tests/engines_tests" "$build/tests/simulator_tests" "$root/gpu/"
  cp -L "$(ldconfig -p | awk '/libvulkan\.so\.1 / {path = $NF} END {print path}')" "$root/gpu/lib/"
  ldd "$build/insonify" "$build"/tests/{engines,simulator}_tests | awk '$2 == "=>" && $3 ~ /^\// {print $3}' | sort -u |
    grep -vE "$own" | xargs -I{} cp -L {} "$root/gpu/lib/"
  strip --strip-unneeded "$root"/gpu/lib/* "$root/gpu/insonify" "$root/gpu/engines_tests" "$root/gpu/simulator_tests"
  tar -C "$root" -cJf "$archive" gpu
  echo "$archive: $(du -h "$archive" | cut -f1)"
}

# The driver of NVIDIA's images is not always where the loader looks.
find_driver() {
  local file=/usr/local/nvidia/share/vulkan/icd.d/nvidia_icd.json
  if [[ -z ${VK_DRIVER_FILES:-} && -r $file ]] && "$program" version | grep -q 'gpu: none'; then
    export VK_DRIVER_FILES=$file
  fi
}

if [[ ${1:-} == --pack ]]; then
  pack "${2:?which FILE}"
  exit
fi
if [[ -x $here/insonify ]]; then
  program=$here/insonify tests=$here
  export LD_LIBRARY_PATH=$here/lib
else
  program=$here/../build/release/insonify tests=$here/../build/release/tests
fi
find_driver
"$program" version
device=${INSONIFY_DEVICE:-0}
read -ra triangles <<<"${INSONIFY_GPU_TRIANGLES:-1000 100000 1000000 10000000}"
run_tests() {
  INSONIFY_DEVICE=$device "$tests/$1" --gtest_brief=1 --gtest_filter="$2" || [[ $? == 77 ]]  # Some were skipped.
}
run_tests engines_tests '*gpu*:GpuEngine*:EngineKindTest.*'
run_tests simulator_tests '*Gpu*'
"$program" bench device --device "$device" --triangles "${triangles[@]}" --json "$here/gpu.json" | tee "$here/gpu.txt"
