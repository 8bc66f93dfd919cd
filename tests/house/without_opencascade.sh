#!/bin/sh
# Without OpenCASCADE the project is configured, and C++ is asked for by nothing.
#
#   without_opencascade.sh REPOSITORY CMAKE GENERATOR CC
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
CXX=$folder/no-compiler "$2" -S "$1" -B "$folder/build" -G "$3" -DCMAKE_C_COMPILER="$4" \
	-DBATTEN_OPENCASCADE=OFF -DBATTEN_REPORT=OFF >"$folder/log" 2>&1 || {
	cat "$folder/log"
	exit 1
}
grep -q 'Without OpenCASCADE' "$folder/log"
"$2" --build "$folder/build" --target help | grep -q batten_program
if "$2" --build "$folder/build" --target help | grep -q batten_opencascade; then
	echo 'the module is built all the same'
	exit 1
fi
