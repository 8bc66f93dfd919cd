#!/bin/sh
# The report of 10000 designs, 1000 of them with their hulls: its size, and what a browser makes of it.
#
#   report.sh MAKE_SWEEP NODE CHROMIUM
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" "$folder/sweep.db" "$DATA/hulls/wigley_noisy.csv" 10000 1000
"$BATTEN" report "$folder/sweep.db" --out "$folder/report.html" --json
size=$(wc -c <"$folder/report.html")
if [ "$size" -gt 12000000 ]; then
	echo "report.html has $size bytes, at most 12000000 were expected"
	exit 1
fi
if grep -qE '(src|href)="?https?:|@import|url\(http' "$folder/report.html"; then
	echo 'report.html asks for something of the network'
	exit 1
fi
"$2" "$here/report.mjs" "$3" "$folder/report.html"
