#!/bin/sh
# kernels/embed.cmake: nested includes, each once, text that CMake likes to eat, and its errors.
#
#   embed.sh REPOSITORY CMAKE CC
set -eu
script=$1/kernels/embed.cmake
cmake=$2
compiler=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir shared kernels
cat >sample.cl <<'END'
#include "shared/outer.h"
// semicolon; [brackets] "quotes" \n ${variable} @variable@ \
continued
  #  include "shared/inner.h"
kernel void copy(global int *a) { a[0] = OUTER; } // ;;
END
printf '#define OUTER INNER;;\n#include "inner.h"\n#define LAST 1' >shared/outer.h
printf '#if 0\n#include <math.h>\n#endif\n#define INNER [1] \\\n ;\n' >shared/inner.h
cat >expected <<'END'
#line 1 "sample.cl"
#line 1 "shared/outer.h"
#define OUTER INNER;;
#line 1 "shared/inner.h"
#if 0
#include <math.h>
#endif
#define INNER [1] \
 ;
#line 3 "shared/outer.h"
#define LAST 1
#line 2 "sample.cl"
// semicolon; [brackets] "quotes" \n ${variable} @variable@ \
continued

kernel void copy(global int *a) { a[0] = OUTER; } // ;;
END
"$cmake" -DINPUT="$folder/sample.cl" -DOUTPUT="$folder/kernels/sample.cl.c" -P "$script"
diff expected kernels/sample.cl
echo 'extern const char kernel_source_sample[];' >kernels/kernel_sources.h
cat >print.c <<'END'
#include "kernels/kernel_sources.h"
#include <stdio.h>
int main(void)
{
	return fputs(kernel_source_sample, stdout) < 0;
}
END
"$compiler" -I. print.c kernels/sample.cl.c -o print
./print | diff expected -

for line in '#include <math.h>' '#include "inner.h"' '#include "shared/absent.h"' \
	'#include NAME' "$(printf '/* \303\251 */')"; do
	printf '%s\n' "$line" >wrong.cl
	if "$cmake" -DINPUT="$folder/wrong.cl" -DOUTPUT="$folder/kernels/wrong.cl.c" -P "$script" \
		2>message; then
		echo "taken without a word: $line"
		exit 1
	fi
	grep -q 'kernels/wrong.cl:' message
done
