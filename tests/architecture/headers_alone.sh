#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every header compiles alone. Most are the first that a source includes, so that compiling the source tests them; this
# compiles the others. A build without precompiled headers (./dev lint) shows which headers of others are missing.
# Usage: headers_alone.sh SOURCE_ROOT COMPILER FLAGS...
set -uo pipefail
cd "$1"
export compiler=$2
shift 2
export flags="$*"
check() {
    # shellcheck disable=SC2086
    echo "#include \"$1\"" | $compiler $flags -I. -fsyntax-only -x c++ - || { echo "$1 does not compile alone"; exit 1; }
}
export -f check
included_first=$(find app core gpu ui tests -name '*.cpp' -exec grep -hm1 '^#include' {} + | sed -n 's/^#include "\(.*\)"/\1/p' | sort -u)
mapfile -t headers < <(find app core gpu ui tests -name '*.h' | sort)
((${#headers[@]} > 100)) || { echo "where are the headers?"; exit 1; }
printf '%s\n' "${headers[@]}" | comm -23 - <(echo "$included_first") | xargs -P "$(nproc)" -I{} bash -c 'check {}'
