#!/bin/sh
# A launcher of the compiler (CMAKE_C_COMPILER_LAUNCHER) that takes an object from another build where the
# list says that it was compiled there by the same command.
#
#   reuse.sh BUILD LIST COMPILER ARGUMENT...
set -eu
build=$1
list=$2
shift 2
before=
object=
for word; do
	[ "$before" = -o ] && object=$word
	before=$word
done
if [ -n "$object" ] && grep -Fqx "$object" "$list"; then
	exec cp "$build/$object" "$object"
fi
exec "$@"
