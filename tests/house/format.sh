#!/bin/sh
# Every C file and kernel is laid out as .clang-format says.
#
#   format.sh REPOSITORY CLANG_FORMAT
set -eu
cd "$1"
find host kernels tests data bench \( -name '*.c' -o -name '*.h' -o -name '*.cl' -o -name '*.cpp' \) -type f \
	-exec "$2" --dry-run -Werror {} +
