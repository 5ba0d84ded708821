#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fuzzes every target, or the named ones, and fails if one breaks.
# Usage: run.sh BIN SECONDS [TARGET...]; inputs that break a target are left in BIN/../fuzz/found.
set -uo pipefail
bin=$1 seconds=$2
shift 2
work=$(dirname "$bin")/fuzz
mkdir -p "$work/found"
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
mapfile -t targets < <("$bin/fuzz_corpus" "$work/corpus")
(($#)) && targets=("$@")
((${#targets[@]})) || { echo "run.sh: there are no targets" >&2; exit 1; }
failed=0
for target in "${targets[@]}"; do
    log=$work/$target.log
    if PELLUCID_FUZZ_TARGET=$target timeout $((seconds + 120)) "$bin/pellucid_fuzz" -max_total_time="$seconds" \
        -timeout=25 -rss_limit_mb=4096 -max_len=65536 -artifact_prefix="$work/found/$target-" "$work/corpus/$target" >"$log" 2>&1 &&
        grep -qE '^Done [1-9][0-9]* runs' "$log"; then
        echo "$target: $(grep -oE '^Done [0-9]+ runs' "$log")"
    else
        echo "$target: broken, see $log"
        grep -E 'ERROR|runtime error|SUMMARY|Test unit written|what\(\)' "$log" | head -5
        failed=1
    fi
done
exit $failed
