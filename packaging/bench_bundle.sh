#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs pellucid-bench with every library that it needs (see copy_programs.sh). Unpack it anywhere and run
# pellucid-bench/pellucid-bench.
#   bench_bundle.sh BIN OUT.tar.gz     BIN has pellucid-bench and pellucid-decode
set -euo pipefail
bin=$1 out=$2
max_megabytes=60

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$(dirname "${BASH_SOURCE[0]}")/copy_programs.sh" "$bin" "$work/pellucid-bench" pellucid-bench
tar -C "$work" -czf "$out" pellucid-bench
megabytes=$(($(stat -c %s "$out") / 1000000))
if ((megabytes >= max_megabytes)); then
    echo "bench_bundle: $out has $megabytes MB; the limit is $max_megabytes MB" >&2
    exit 1
fi
echo "bench_bundle: $out, $megabytes MB"
