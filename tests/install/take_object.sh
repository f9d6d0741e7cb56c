#!/bin/sh
# take_object.sh BUILD COMPILER ARGS... -- what CMake calls instead of the compiler where a second build tree of the same
# sources is made: takes the object file from the tree BUILD if that has it, and compiles if not.
build=$1
shift
object= depfile= previous=
for word; do
  case $previous in
    -o) object=$word ;;
    -MF) depfile=$word ;;
  esac
  previous=$word
done
case $object in
  */shipped_folder.cpp.o) ;;  # A static library knows the source tree.
  *.cpp.o | *.cxx.o)
    if [ -f "$build/$object" ]; then
      echo "$object:" >"$depfile"
      exec cp "$build/$object" "$object"
    fi ;;
esac
exec "$@"
