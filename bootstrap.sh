#!/bin/sh
# From a bare Debian 12 to pictures of a faired hull, or to a tested build.
#
#   sh bootstrap.sh         builds into build/
#   sh bootstrap.sh demo    builds, fairs a real hull, says where the pictures are
#   sh bootstrap.sh test    builds and runs every test, then the sanitizers
#
# Debian packages that are missing are installed as root or by sudo; without either, the one line that
# installs them is printed and the exit code is 6. Once they are there, the network is used for one
# thing, the modules of the report's page, and batten builds without these. May be run again and again, in
# any order, from anywhere.
set -eu

usage()
{
	echo "usage: sh bootstrap.sh [demo | test]"
}

root=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
cd "$root"
if [ $# -gt 1 ]; then
	usage >&2
	exit 2
fi
action=${1:-build}
case $action in
build | demo | test) ;;
-h | --help)
	usage
	exit 0
	;;
*)
	usage >&2
	exit 2
	;;
esac

say()
{
	printf '%s\n' "$*"
}

# ---- Packages -----------------------------------------------------------------------------------
# One a word; a|b: a is installed unless b is there.
packages="
gcc libc6-dev
cmake ninja-build pkg-config
libjansson-dev
libcairo2-dev
libpng-dev
libxxhash-dev
libsqlite3-dev
librandom123-dev
opencl-c-headers|ocl-icd-opencl-dev
libvulkan-dev
glslang-tools
g++ libocct-data-exchange-dev
"
# gcc libc6-dev: the compiler, and the C library's headers. cmake ninja-build pkg-config: the build.
# jansson: JSON reports. cairo: line drawings, text on pictures. png: pictures. xxhash: keys of
# compiled kernels. sqlite3: databases of sweeps. random123: random designs, by counter. The headers of
# OpenCL and Vulkan: both libraries are opened at run time. glslang-tools: shaders to SPIR-V.
# g++ libocct-data-exchange-dev: IGES and STEP; batten builds without them, too.

run_packages="
ocl-icd-libopencl1|nvidia-libopencl1
pocl-opencl-icd binutils
libvulkan1
mesa-vulkan-drivers
fonts-dejavu-core
"
# The loaders of OpenCL and Vulkan, and a driver of each that needs no graphics card: PoCL, lavapipe.
# binutils: PoCL links kernels by ld.
# The font of titles and scales.

test_packages="
libcmocka-dev
libnlopt-dev
clang libclang-rt-dev|libclang-rt-14-dev
clang-format clang-tidy
vulkan-validationlayers
libxml2-utils librsvg2-bin
gmsh
sqlite3
chromium
slurm-wlm munge parallel
oclgrind
"
# cmocka: unit tests. nlopt: the optimum that a search is compared with. clang: the second compiler, the
# kernels' syntax, and with libclang-rt AddressSanitizer. clang-format clang-tidy: layout and lint.
# vulkan-validationlayers: misuse of Vulkan. xmllint and rsvg-convert: SVG files. gmsh: opens the IGES and
# STEP files, as an independent program. sqlite3: reads the databases of sweeps. oclgrind: watches kernels at
# work. slurm-wlm munge parallel: shards of a sweep on a cluster of one machine. chromium: the page of
# batten report in a real browser.

# nodejs npm: the page of batten report. Other sources' nodejs brings npm along and cannot stand beside
# Debian's, so whoever has the commands needs no package. The page's modules come from the registry that
# npm is set up for, when the build is configured first; where there is none, batten builds without it.
if command -v npm >/dev/null 2>&1 && { command -v node || command -v nodejs; } >/dev/null 2>&1; then
	page_packages=
else
	page_packages="nodejs npm"
fi

is_installed()
{
	[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Prints those of the packages that are not installed.
missing_of()
{
	for choice in "$@"; do
		first=${choice%%|*}
		if is_installed "$first"; then
			continue
		fi
		case $choice in
		*'|'*) is_installed "${choice#*|}" && continue ;;
		esac
		printf ' %s' "$first"
	done
}

install_packages()
{
	if ! command -v dpkg-query >/dev/null 2>&1; then
		say "Not a Debian system: packages are taken as they are. Debian's names for what is needed:"
		say "$*" | tr '\n' ' '
		say ""
		return 0
	fi
	missing=$(missing_of "$@")
	if [ -z "$missing" ]; then
		return 0
	fi
	if [ "$(id -u)" = 0 ]; then
		as_root=
	elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
		as_root='sudo -n'
	else
		say "Packages are missing, and installing them takes root or sudo. As root:"
		say "    apt-get update && apt-get install -y --no-install-recommends$missing"
		exit 6
	fi
	say "Installing:$missing"
	apt="$as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300"
	# shellcheck disable=SC2086
	if ! $apt update || ! $apt install -y --no-install-recommends $missing; then
		say "These packages could not be installed:$missing" >&2
		exit 6
	fi
}

# ---- Build and run ------------------------------------------------------------------------------
jobs=$(nproc 2>/dev/null || echo 2)

# configure PRESET FOLDER OPTION...; starts afresh where the folder was configured for another place
# or another build tool.
configure()
{
	preset=$1
	folder=$2
	shift 2
	cache=$folder/CMakeCache.txt
	if [ -f "$cache" ] && ! {
		grep -Fqx "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" &&
			grep -Fqx 'CMAKE_GENERATOR:INTERNAL=Ninja' "$cache"
	}; then
		set -- "$@" --fresh
	fi
	cmake --log-level=WARNING --preset "$preset" "$@"
	cmake --build "$folder" --parallel "$jobs"
}

# run_tests FOLDER LABELS: all tests of these labels; one that is skipped, disabled or not run is a
# failure, and so is a run of none. Adds to the totals.
passed=0
failed=0
run_tests()
{
	registered=$(ctest --test-dir "$1" -N -L "$2" | sed -n 's/^Total Tests: //p')
	report=$root/$1/tests.xml
	rm -f "$report"
	ctest --test-dir "$1" -L "$2" --output-on-failure --no-tests=error --parallel "$jobs" \
		--output-junit "$report" || true
	good=0
	if [ -f "$report" ]; then
		good=$(grep -c '<testcase .*status="run"' "$report" || true)
	fi
	passed=$((passed + good))
	failed=$((failed + ${registered:-0} - good))
	if [ "${registered:-0}" -eq 0 ]; then
		say "$1: no test carries the label $2"
		failed=$((failed + 1))
	elif [ "$good" -ne "$registered" ]; then
		say "$1: $good of $registered tests passed"
	fi
}

# shellcheck disable=SC2046,SC2086
case $action in
build) install_packages $packages $page_packages ;;
demo) install_packages $packages $page_packages $run_packages ;;
test) install_packages $packages $page_packages $run_packages $test_packages ;;
esac

case $action in
build)
	configure release build -DBATTEN_TESTS=OFF
	say "Built: build/batten"
	;;
demo)
	configure release build -DBATTEN_TESTS=OFF
	build/batten fair data/hulls/npl_parent.csv --out demo
	say "The curvature of the hull before and after: demo/before.png demo/after.png"
	say "Its lines, the faired offsets, the report:   demo/lines.svg demo/faired.csv demo/report.json"
	say "(all under $root)"
	;;
test)
	configure release build -DBATTEN_TESTS=ON
	run_tests build '^(fast|full)$'
	configure asan build/asan
	run_tests build/asan '^fast$'
	configure tsan build/tsan
	run_tests build/tsan '^tsan$'
	say "$passed passed, $failed failed"
	[ "$failed" -eq 0 ]
	;;
esac
