#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every test that tests/complaints.md names is there. Usage: complaints.sh SOURCE_ROOT
set -uo pipefail
cd "$1"
failed=0
named=0
while read -r suite name; do
    named=$((named + 1))
    grep -rqE "(TEST|TEST_F|TEST_P)\\($suite, $name\\)" tests && continue
    file=$(find tests -name "$suite.cpp")
    [[ -n $file ]] && grep -q "void $name()" "$file" && continue
    echo "tests/complaints.md: there is no test $suite.$name"
    failed=1
done < <(grep -oE '`[A-Za-z_]+\.[A-Za-z]+`' tests/complaints.md | grep -v architecture | tr -d '`' | tr . ' ' | sort -u)
((named > 10)) || { echo "tests/complaints.md names no tests"; failed=1; }
exit $failed
