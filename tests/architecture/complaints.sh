#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that every test named in tests/complaints.md and SECURITY.md exists. Usage: complaints.sh SOURCE_ROOT
set -uo pipefail
cd "$1"
failed=0
for document in tests/complaints.md SECURITY.md; do
    named=0
    while read -r suite name; do
        named=$((named + 1))
        # `Suite.*` names all tests of a suite.
        [[ $name == '*' ]] && pattern="(TEST|TEST_F|TEST_P)\\($suite, " || pattern="(TEST|TEST_F|TEST_P)\\($suite, $name\\)"
        grep -rqE "$pattern" tests && continue
        file=$(find tests -name "$suite.cpp")
        [[ -n $file ]] && grep -q "void $name()" "$file" && continue
        echo "$document: there is no test $suite.$name"
        failed=1
    done < <(grep -oE '`[A-Za-z_]+\.([A-Za-z0-9]+|\*)`' "$document" | grep -v -e architecture -e hidpi | tr -d '`' | tr . ' ' | sort -u)
    ((named > 10)) || { echo "$document names no tests"; failed=1; }
done
exit $failed
