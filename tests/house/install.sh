#!/bin/sh
# Installs into an empty folder and builds a program of ten lines against what is there, once by
# pkg-config and once by CMake's find_package, with the static and with the shared library.
#
#   install.sh REPOSITORY BUILD CMAKE GENERATOR CC
set -eu
repository=$1
build=$2
cmake=$3
generator=$4
compiler=$5
version=$(sed -n 's/^project(batten VERSION \([0-9.]*\).*/\1/p' "$repository/CMakeLists.txt")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/user"
cat >"$folder/user/user.c" <<'END'
#include <batten.h>
#include <stdio.h>

int main(void)
{
	batten_context *context = NULL;
	batten_status status = batten_context_create(NULL, &context);
	puts(batten_version());
	batten_context_destroy(context);
	return batten_status_exit_code(status);
}
END
cat >"$folder/user/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES C)
find_package(batten 0.1 REQUIRED)
add_executable(user user.c)
target_link_libraries(user PRIVATE batten::batten)
END

# Says what is wrong and ends the test.
fail()
{
	echo "$1"
	exit 1
}

check()
{
	prefix=$folder/$1
	library=$(dirname "$(find "$prefix" -name 'libbatten.*' | head -n 1)")
	[ "$("$prefix/bin/batten" --version | grep -c "$version")" -ge 1 ] || fail "$1: batten --version"
	cmp "$repository/data/hulls/npl_parent.csv" "$prefix/share/batten/hulls/npl_parent.csv"
	# The module is found where it is installed; a build without it says so.
	if [ -n "$(find "$prefix" -name batten_opencascade.so)" ]; then
		env -u BATTEN_MODULE_PATH "$prefix/bin/batten" surface "$repository/data/hulls/wigley.csv" \
			--net 3x3 --order 3x3 --out "$folder/$1.igs" >/dev/null || fail "$1: the module is not found"
	fi

	# So is the report's page: without it, that is what would be said.
	if [ -n "$(find "$prefix" -name batten_report.html)" ]; then
		env -u BATTEN_MODULE_PATH "$prefix/bin/batten" report "$folder/none.db" --out "$folder/$1.html" \
			2>"$folder/log" || true
		grep -q 'none.db: cannot be read' "$folder/log" || fail "$1: the report's page is not found"
	fi

	PKG_CONFIG_PATH=$library/pkgconfig
	export PKG_CONFIG_PATH
	[ "$(pkg-config --modversion batten)" = "$version" ] || fail "$1: version of batten.pc"
	# shellcheck disable=SC2046
	"$compiler" -std=c11 -Wall -Werror "$folder/user/user.c" -o "$folder/user-$1" \
		$(pkg-config --cflags --libs batten)
	[ "$(LD_LIBRARY_PATH=$library "$folder/user-$1")" = "$version" ] || fail "$1: user by pkg-config"

	"$cmake" -S "$folder/user" -B "$folder/user-build-$1" -G "$generator" \
		-DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$compiler" >"$folder/log" || fail "$(cat "$folder/log")"
	"$cmake" --build "$folder/user-build-$1" >"$folder/log" || fail "$(cat "$folder/log")"
	[ "$("$folder/user-build-$1/user")" = "$version" ] || fail "$1: user by find_package"
}

# The commands of a build, wherever it is, by which of its objects are made.
commands()
{
	sed -n "s|$1|BUILD|g; s|^ *\"command\": ||p" "$1/compile_commands.json" | sort
}

# The build at hand with its modules, then the other kind of library without. To compile everything again
# would take longer than any other test of the house, so what the same command makes is not made twice.
"$cmake" --install "$build" --prefix "$folder/static" >/dev/null
check static
type=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$build/CMakeCache.txt")
"$cmake" -S "$repository" -B "$folder/shared-build" -G "$generator" -DCMAKE_C_COMPILER="$compiler" \
	-DCMAKE_C_COMPILER_LAUNCHER="sh;$repository/tests/house/reuse.sh;$build;$folder/same" \
	-DCMAKE_BUILD_TYPE="$type" -DBUILD_SHARED_LIBS=ON -DBATTEN_REPORT=OFF -DBATTEN_OPENCASCADE=OFF >/dev/null
commands "$build" >"$folder/commands"
commands "$folder/shared-build" | comm -12 "$folder/commands" - | sed -n 's/.* -o \([^ ]*\) -c .*/\1/p' >"$folder/same"
"$cmake" --build "$folder/shared-build" >"$folder/log" || fail "$(cat "$folder/log")"
"$cmake" --install "$folder/shared-build" --prefix "$folder/shared" >/dev/null
check shared
