# What the tests of the program share; sourced by them, no test itself. A test gets BATTEN, the
# program, and DATA, the data folder, works in a folder of its own and ends with 'finish'. Names
# that begin with an underscore belong to this file.
set -u
: "${BATTEN:?the program}" "${DATA:?the data folder}"
case $BATTEN in /*) ;; *) BATTEN=$PWD/$BATTEN ;; esac
case $DATA in /*) ;; *) DATA=$PWD/$DATA ;; esac
LC_ALL=C
export LC_ALL
folder=$(mktemp -d) || exit 1
# A name without blanks, whatever folder the project lies in.
links=$(mktemp -d) || exit 1
trap 'rm -rf "$folder" "$links"' EXIT
ln -s "$DATA/hulls" "$links/hulls" || exit 1
hulls=$links/hulls
trap 'exit 1' HUP INT TERM
cd "$folder" || exit 1
failures=0

fail()
{
	printf 'FAILED: %s\n' "$*"
	failures=$((failures + 1))
}

finish()
{
	[ "$failures" -eq 0 ] || exit 1
	exit 0
}

# Most tests look at numbers and leave the pictures to the tests that are about them.
without_pictures()
{
	VK_DRIVER_FILES=$folder/no-driver
	VK_ICD_FILENAMES=$VK_DRIVER_FILES
	export VK_DRIVER_FILES VK_ICD_FILENAMES
}

# The program with these arguments, its output in $out, its talk in $talk, its exit code in $code.
# What a sanitizer finds fails the test even where the exit code is the one that was expected.
out=$folder/.out
talk=$folder/.talk
run()
{
	"$BATTEN" "$@" >"$out" 2>"$talk" </dev/null
	code=$?
	if grep -q 'Sanitizer\|runtime error: ' "$talk"; then
		fail "batten $*: a sanitizer's report"
		cat "$talk"
	fi
}

# expect CODE ARGUMENT...: runs the program, which must end with this exit code.
expect()
{
	_code=$1
	shift
	run "$@"
	if [ "$code" -ne "$_code" ]; then
		fail "batten $*: exit code $code, expected $_code; it said:"
		cat "$talk"
	fi
}

# says PATTERN: the talk of the last run has a line like this.
says()
{
	grep -q -- "$1" "$talk" && return
	fail "no line like '$1' on standard error, but:"
	cat "$talk"
}

# prints PATTERN: the output of the last run has a line like this.
prints()
{
	grep -q -- "$1" "$out" && return
	fail "no line like '$1' on standard output, but:"
	cat "$out"
}

# one_line: the last run printed one line of talk and nothing else.
one_line()
{
	[ -s "$out" ] && fail "standard output is not empty: $(head -n 1 "$out")"
	# A sanitizer that misses its symbolizer says so on lines of its own.
	[ "$(grep -vc '^==[0-9]*==WARNING: .*symbolizer' "$talk")" -eq 1 ] && return
	fail 'not one line on standard error, but:'
	cat "$talk"
}

# Every name and every content below a folder: what changed shows as a difference of two of these.
state_of()
{
	(cd "$1" && find . | sort && find . -type f -exec cksum {} + | sort)
}

# holds WHAT EXPRESSION NAME=VALUE...: an inequality over numbers, in awk's notation.
holds()
{
	_what=$1
	_expression=$2
	shift 2
	_numbers=
	for _pair in "$@"; do
		case ${_pair#*=} in
		'' | *[!-+.0-9eE]*)
			fail "$_what: ${_pair%%=*} is no number: '${_pair#*=}'"
			return
			;;
		esac
		_numbers="$_numbers ${_pair%%=*} = ${_pair#*=};"
	done
	awk "BEGIN { $_numbers exit !($_expression) }" </dev/null ||
		fail "$_what: not $_expression with$_numbers"
}

# member FILE NAME: a member of the outermost object of a JSON file as the program lays it out
# (two blanks a level). member FILE OBJECT NAME: a member of an object in it. Text without its
# quotes.
member()
{
	awk -v object="${3:+$2}" -v name="${3:-$2}" '
		BEGIN { start = "^  \"" object "\": \\{"; indent = object == "" ? "  " : "    " }
		object != "" && $0 ~ start { inside = 1; next }
		object != "" && inside && /^  }/ { exit }
		(object == "" || inside) && index($0, indent "\"" name "\": ") == 1 {
			sub(/^ *"[^"]*": /, "")
			sub(/,$/, "")
			sub(/^"/, "")
			sub(/"$/, "")
			print
			exit
		}' "$1"
}

# line_member FILE KIND COORDINATE NAME: a number of one entry of a report's "lines".
line_member()
{
	awk -v kind="\"$2\"" -v place="$3" -v name="\"$4\":" '
		{ sub(/,$/, "") }
		/^    \{/ { good = 0; found = "" }
		$1 == "\"kind\":" { good = $2 == kind }
		$1 == "\"x_m\":" || $1 == "\"z_m\":" { here = $2 + 0 }
		$1 == name { found = $2 }
		/^    }/ && good && here - place < 1e-9 && place - here < 1e-9 { print found; exit }' "$1"
}

# JSON by reduction: texts become @, other literals #, then every array and object of those
# becomes #, until one is left.
json_is_valid()
{
	awk '
		{
			gsub(/"([^"\\]|\\["\\\/bfnrt]|\\u[0-9a-fA-F][0-9a-fA-F][0-9a-fA-F][0-9a-fA-F])*"/, "@")
			gsub(/true|false|null/, "#")
			gsub(/-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][-+]?[0-9]+)?/, "#")
			gsub(/[ \t]+/, "")
			text = text $0
		}
		END {
			while (gsub(/\{(@:[@#](,@:[@#])*)?}|\[([@#](,[@#])*)?]/, "#", text) > 0)
				continue
			exit text != "#"
		}' "$1"
}

expect_json()
{
	json_is_valid "$1" || fail "$1: not one JSON value"
}

# expect_schema NAME FILE: the file is what data/schema/NAME.schema.json describes.
expect_schema()
{
	"${CHECK_SCHEMA:?the checker of schemas}" "$DATA/schema/$1.schema.json" "$2" >.schema ||
		fail "$2 is not what $1.schema.json describes: $(head -5 .schema)"
}

# The table of an offsets file of layout grid without header and comments.
table_of()
{
	grep -v '^#' "$1"
}

# cell FILE STATION WATERLINE: the half-breadth there, coordinates as numbers of the file.
cell()
{
	table_of "$1" | awk -F, -v x="$2" -v z="$3" '
		NR == 1 { for (i = 2; i <= NF; i++) if ($i + 0 == x + 0) at = i; next }
		$1 + 0 == z + 0 { print $at; exit }'
}

# change A B: the largest and the root mean square difference of the half-breadths of two tables
# of layout grid, over the cells with a number in both, and how many these are.
change()
{
	table_of "$1" >.first
	table_of "$2" >.second
	paste -d, .first .second | awk -F, '
		NR > 1 {
			n = NF / 2
			for (i = 2; i <= n; i++)
				if ($i ~ /[0-9]/ && $(n + i) ~ /[0-9]/) {
					d = $i - $(n + i)
					if (d < 0) d = -d
					if (d > most) most = d
					sum += d * d
					count++
				}
		}
		END { printf "%.17g %.17g %d\n", most, sqrt(sum / count), count }'
}

# half_beam FILE: the largest number among the half-breadths of a table of either layout.
half_beam()
{
	table_of "$1" | awk -F, 'NR == 1 { first = $2 == "z" || $2 == "x" ? 4 : 2; next }
		{ for (i = first; i <= NF; i++) if ($i + 0 > most) most = $i + 0 }
		END { printf "%.17g\n", most }'
}

# same_form A B: B is a hull on the table of A: the same header, coordinates, cells outside the
# hull, unknown cells, profile points and rows after the table. B may say that it was faired or varied.
same_form()
{
	for _file in "$1" "$2"; do
		grep '^# [a-z-]*: ' "$_file" | sed '/^# source: /s/\(; \|: \)\(fair\|vari\)ed by batten [0-9.]*$/\1/; s/; $//
			/^# source: $/d'
		table_of "$_file" | awk -F, '
			NR == 1 { first = $2 == "z" || $2 == "x" ? 4 : 2; print; next }
			/^profile|^knuckle/ { print; next }
			{
				line = first == 4 ? $1 : ""
				for (i = first == 4 ? 2 : 1; i < first; i++) line = line "," sprintf("%.15g", $i)
				for (i = first; i <= NF; i++)
					line = line "," ($i == "" || $i == "?" ? $i : $i > 0 ? "+" : $i == 0 ? "0" : "-")
				print line
			}'
	done >.forms
	_half=$(($(grep -c '' .forms) / 2))
	head -n "$_half" .forms >.first
	tail -n "+$((_half + 1))" .forms >.second
	cmp -s .first .second && return
	fail "$2 is not on the table of $1:"
	diff .first .second | head -n 6
}
