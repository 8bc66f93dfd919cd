#!/bin/sh
# The shared library exports what batten.h declares: all of it, and nothing else.
#
#   symbols.sh REPOSITORY LIBRARY
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
nm -D --defined-only "$2" | awk '{ print $NF }' | LC_ALL=C sort >"$folder/exported"
# A declaration may run over several lines; its name stands before the first parenthesis.
awk '/^BATTEN_API/ { sub(/\(.*/, ""); sub(/.*[ *]/, ""); print }' "$1"/host/include/batten/*.h |
	LC_ALL=C sort >"$folder/declared"
[ "$(wc -l <"$folder/declared")" -ge 20 ]
if grep -v '^batten_' "$folder/declared"; then
	echo "^ declared in batten.h without the prefix batten_"
	exit 1
fi
if ! diff "$folder/declared" "$folder/exported"; then
	echo "^ declared in batten.h but not exported (<), exported but not declared (>)"
	exit 1
fi
