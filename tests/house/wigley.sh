#!/bin/sh
# The shipped Wigley hulls are what their program writes.
#
#   wigley.sh GENERATE_WIGLEY HULLS
set -eu
"$1" exact | cmp - "$2/wigley.csv"
"$1" noisy | cmp - "$2/wigley_noisy.csv"
