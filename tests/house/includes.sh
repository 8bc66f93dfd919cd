#!/bin/sh
# Who may include whom. Arrows between the rooms go downward only; the table below is the one of the
# README. A room may always include itself and the public header batten.h.
#
#   includes.sh REPOSITORY
set -eu
cd "$1"

# A room stands below those it may use, so that no cycle can be written down here.
table='
core
shared
kernels       shared
hull          core
device        core
reference     shared
batch         core device reference shared generated-kernels
geometry      core hull batch shared
io            core hull geometry
exchange      core hull geometry
picture       core hull geometry shared generated-shaders
ray           core hull geometry
hydrostatics  core hull geometry batch shared
variation     core hull geometry batch hydrostatics shared
fairing       core hull geometry batch hydrostatics shared
sweep         core hull geometry batch io exchange picture ray hydrostatics variation fairing shared
report        core hull geometry picture sweep
bench         shared kernels
cli           bench
data
oracle
support       core hull device reference batch geometry io picture ray hydrostatics variation fairing
support       oracle
test          core hull device reference batch geometry io exchange picture ray hydrostatics variation fairing
test          report sweep shared oracle support generated-kernels
'

# Headers of libraries, each wrapped in few rooms; a header that is not listed is free.
libraries='
CL/       device
vulkan/   picture test
cairo     picture
png.h     picture test
jansson.h cli report sweep io test
xxhash.h  device sweep
sqlite3.h report sweep test support
cmocka.h  test support
nlopt.h   test oracle bench
Random123 sweep data test
'

find host kernels tests data bench \( -name '*.c' -o -name '*.h' -o -name '*.cl' -o -name '*.cpp' \) -type f 2>/dev/null |
	LC_ALL=C sort >"${TMPDIR:-/tmp}/batten-includes.$$"
trap 'rm -f "${TMPDIR:-/tmp}/batten-includes.$$"' EXIT

# shellcheck disable=SC2016
TABLE=$table LIBRARIES=$libraries awk '
BEGIN {
	count = split(ENVIRON["TABLE"], rows, "\n")
	for (i = 1; i <= count; i++) {
		n = split(rows[i], word, /[ \t]+/)
		if (word[1] == "") continue
		for (j = 2; j <= n; j++) {
			may[word[1], word[j]] = 1
			if (!(word[j] in known) && word[j] !~ /^generated-/) {
				print "includes.sh: " word[1] " may use " word[j] ", which is not above it"
				bad = 1
			}
		}
		known[word[1]] = 1
	}
	libraries = 0
	count = split(ENVIRON["LIBRARIES"], rows, "\n")
	for (i = 1; i <= count; i++)
		if (rows[i] != "") library[++libraries] = rows[i]
	while ((getline file < "/dev/stdin") > 0) { check(file); files++ }
	if (files < 10) { print "includes.sh: only " files + 0 " files found"; bad = 1 }
	exit bad
}

function room_of(file, part, n) {
	n = split(file, part, "/")
	if (part[1] == "host") return n > 3 || part[2] != "include" ? part[2] : "include"
	if (part[1] == "kernels") return part[2] == "shared" ? "shared" : "kernels"
	if (part[1] == "tests" && part[2] == "support") return "support"
	if (part[1] == "tests" && part[2] == "oracle" && part[n] !~ /^test_/) return "oracle"
	if (part[1] == "tests") return "test"
	return part[1]
}

function complain(file, number, text) {
	print file ":" number ": " text
	bad = 1
}

function exists(path, line, found) {
	found = (getline line < path) >= 0
	close(path)
	return found
}

# The room that file reaches with #include "name".
function target_of(file, name, folder, first) {
	folder = file
	sub(/[^\/]*$/, "", folder)
	if (name == "batten.h") return "public"
	if (name ~ /\.\./) return "nowhere"
	if (name == "kernels/kernel_sources.h") return "generated-kernels"
	if (name ~ /^shaders\/[a-z_]+\.(vert|frag)\.h$/) return "generated-shaders"
	if (exists(folder name)) return room_of(folder name)
	if (exists("kernels/" name)) return room_of("kernels/" name)
	if (exists("tests/" name)) return room_of("tests/" name)
	if (exists("host/" name)) return room_of("host/" name)
	if (exists("bench/" name)) return room_of("bench/" name)
	return "nowhere"
}

function check(file, room, line, number, name, target, i, part, allowed) {
	room = room_of(file)
	if (room == "include") room = "core"
	if (!(room in known)) { complain(file, 1, "the room " room " is not in the table"); return }
	while ((getline line < file) > 0) {
		number++
		if (line !~ /^[ \t]*#[ \t]*include/) continue
		name = line
		if (line ~ /"/) {
			sub(/^[^"]*"/, "", name); sub(/".*$/, "", name)
			target = target_of(file, name)
			if (target == "include") target = "core"
			if (target == "public" && (room == "shared" || room == "kernels"))
				complain(file, number, "a kernel includes batten.h")
			else if (target == "nowhere")
				complain(file, number, "\"" name "\" is no header of the project")
			else if (target != "public" && target != room && !((room, target) in may))
				complain(file, number, room " may not include " target " (\"" name "\")")
		} else if (line ~ /</) {
			sub(/^[^<]*</, "", name); sub(/>.*$/, "", name)
			if (room == "kernels" || room == "shared" && name != "math.h")
				complain(file, number, "a kernel includes <" name ">")
			if (name ~ /\.hxx$/ && room != "exchange" && room != "bench")
				complain(file, number, room " may not include <" name ">")
			for (i = 1; i <= libraries; i++) {
				split(library[i], part, /[ \t]+/)
				if (index(name, part[1]) != 1) continue
				allowed = " " library[i] " "
				sub(/^ [^ ]+/, "", allowed)
				if (index(allowed, " " room " ") == 0)
					complain(file, number, room " may not include <" name ">")
			}
		} else
			complain(file, number, "an include that names no file")
	}
	close(file)
}' <"${TMPDIR:-/tmp}/batten-includes.$$"
