#!/bin/sh
# What no file of the project may hold: absolute paths of somebody's machine, addresses of package
# registries, carriage returns, blanks at the end of a line, a last line without an end. And every
# folder that a reader opens has a README.md.
#
#   text.sh REPOSITORY
set -eu
cd "$1"
bad=0

list=$(mktemp)
found=$(mktemp)
trap 'rm -f "$list" "$found"' EXIT
find . \( -path ./.git -o -path ./build -o -path ./demo -o -name '*-faired' \) -prune -o \
	-type f -print | grep -Ev '\.(png|pdf|bin)$' | grep -v '^\./tests/fuzz/corpus/' >"$list"

# Every line grep prints for the pattern $1 in the files of the list is a fault called $2.
forbid()
{
	tr '\n' '\0' <"$list" | xargs -0 grep -nE -- "$1" /dev/null >"$found" || true
	if [ -s "$found" ]; then
		echo "$2:"
		cat "$found"
		bad=1
	fi
}

# The brackets keep this file from finding itself.
forbid '(^|[^A-Za-z0-9_.}])/(wor[k]|roo[t]|hom[e]|User[s])/' 'an absolute path of one machine'
forbid 'debian[.]or[g]|npmjs[.]or[g]|pypi[.]or[g]|crates[.]i[o]' 'an address of a package registry'
forbid "$(printf '\r')" 'a carriage return'
tab=$(printf '\t')
forbid "[ $tab]\$" 'a blank at the end of a line'

while read -r file; do
	if [ -s "$file" ] && [ -n "$(tail -c 1 "$file")" ]; then
		echo "$file: the last line has no end"
		bad=1
	fi
done <"$list"

for folder in host host/*/ kernels shaders bench tests data; do
	case $folder in host/include/) continue ;; esac
	if [ ! -s "${folder%/}/README.md" ]; then
		echo "${folder%/}: has no README.md"
		bad=1
	fi
done
exit $bad
