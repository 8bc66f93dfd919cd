#!/bin/sh
# Rules for kernels/ beyond what a compiler says, then the compiler. Local memory comes in as an
# argument: PoCL 3.1 miscompiles an array declared inside a kernel, silently. Nothing but + - * /
# sqrt fma and comparisons where results are compared: no built-in function whose last bits are a
# device's own, no atomics.
#
#   kernels.sh REPOSITORY FOLDER CLANG       FOLDER: the kernels with their includes resolved
set -eu
cd "$1"
embedded=$2
clang=$3
bad=0

forbid()
{
	if grep -nE -- "$1" kernels/*.cl kernels/shared/*.h /dev/null; then
		echo "^ $2"
		bad=1
	fi
}

forbid '(^|[^A-Za-z0-9_*])((__)?local|STATE)[ \t]+([A-Za-z0-9_]+[ \t]+)+[A-Za-z0-9_]+[ \t]*(\[|;|=)' \
	'local memory declared inside a kernel'
forbid '(^|[^A-Za-z0-9_])(native_|half_)?(sin|cos|tan|asin|acos|atan|atan2|exp|exp2|log|log2|pow|pown|powr|rsqrt|cbrt|hypot|mad|length|normalize|dot)[ \t]*\(' \
	'a function whose result is not the same on every device'
forbid 'atom(ic)?_[a-z]+[ \t]*\(' 'an atomic operation'
forbid 'cl-(fast-relaxed|unsafe|mad|finite)|FP_CONTRACT[ \t]+ON' 'relaxed arithmetic'

# Every precision with every kind of lanes and of state, each pair once at least, and searches abreast; the
# header of built-in functions takes most of a build.
count=0
for file in "$embedded"/*.cl; do
	abreast=
	case $(basename "$file") in
	multilevel.cl | textbook.cl | block_search.cl | net_search.cl | net_block.cl)
		abreast='1,1,global,-DSTATE_IS_GLOBAL,-DBATTEN_ABREAST=4 0,1,global,-DSTATE_IS_GLOBAL,-DBATTEN_ABREAST=8,-DBATTEN_ALONE'
		;;
	esac
	for options in 0,1,local 0,2,global 0,16,local,-DBATTEN_PREFETCH,-DBATTEN_ALONE 1,1,global 1,2,local \
		1,16,global,-DBATTEN_PREFETCH,-DBATTEN_ALONE $abreast; do
		# shellcheck disable=SC2086
		set -- $(echo "$options" | tr , ' ')
		options="-DBATTEN_DOUBLE=$1 -DBATTEN_LANES=$2 -DSTATE=$3"
		shift 3
		options="$options $*"
		# shellcheck disable=SC2086
		if ! "$clang" -x cl -cl-std=CL1.2 -target spir64-unknown-unknown -Xclang \
			-finclude-default-header -fsyntax-only -Wall -Wextra -Wno-unused-function \
			-Werror $options "$file"; then
			echo "$(basename "$file"): does not compile with $options"
			bad=1
		fi
		count=$((count + 1))
	done
done
echo "$count builds of kernels checked"
[ "$count" -ge 20 ] || bad=1
exit $bad
