#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The bundle of pellucid-bench measures from a folder without anything else: its programs run with their own libraries and
# need no others than glibc's.
#   bench_bundle_test.sh SOURCE BIN TESTS
set -euo pipefail
source=$1 bin=$2 tests=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export SOURCE_DATE_EPOCH=1700000000
run=$work/pellucid-bench.run
"$source/packaging/bench_bundle.sh" "$bin" "$tests" "$run"
sh "$run" --noexec --target "$work/bundle" --quiet
"$source/tests/packaging/is_self_contained.sh" "$work/bundle" pellucid-bench pellucid-decode gpu_test
# A volume, which the decoder reads.
{
    printf 'NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 16 16\nencoding: raw\nendian: little\n'
    printf 'space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n'
    head -c $((16 * 16 * 16 * 4)) /dev/zero | tr '\0' '?'
} >"$work/volume.nrrd"
bare() { (cd "$work" && env -i HOME="$work" PATH=/usr/bin:/bin sh "$run" --quiet -- "$@"); }
bare --suite scaling --volume volume.nrrd >"$work/measured"
grep -q 16x16x16 "$work/measured"
# The time is up after the first row: what was measured is written.
bare --suite quick --within 0.0001 --json figures.json >"$work/measured"
grep -q 'time is up' "$work/measured"
grep -q '"suite": *"quick"' "$work/figures.json"
bare --help | grep -q -- --suite
