#!/bin/sh
# The public header stands alone, and so does each part of it: C11 -pedantic, C++17, and twice in one file.
#
#   header.sh REPOSITORY CC CXX
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/user.c" <<'END'
#include "batten.h"
#include "batten.h"
int main(void)
{
	return batten_version() == 0 || BATTEN_OK != 0;
}
END
cp "$folder/user.c" "$folder/user.cpp"
sed -i 's/(void)/()/' "$folder/user.cpp"
set -- "$1/host/include" "$2" "$3"
"$2" -std=c11 -pedantic -Wall -Wextra -Werror -I"$1" -fsyntax-only "$folder/user.c"
"$3" -std=c++17 -pedantic -Wall -Wextra -Werror -I"$1" -fsyntax-only "$folder/user.cpp"
for part in "$1"/batten/*.h; do
	"$2" -std=c11 -pedantic -Wall -Wextra -Werror -fsyntax-only -x c "$part"
done
