#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every header compiles alone. Usage: headers_alone.sh SOURCE_ROOT COMPILER FLAGS...
set -uo pipefail
cd "$1"
compiler=$2
shift 2
export compiler
export flags="$*"
check() {
    # shellcheck disable=SC2086
    echo "#include \"$1\"" | $compiler $flags -I. -fsyntax-only -x c++ - || { echo "$1 does not compile alone"; exit 1; }
}
export -f check
find app core gpu ui tests -name '*.h' | sort | xargs -P "$(nproc)" -I{} bash -c 'check {}'
