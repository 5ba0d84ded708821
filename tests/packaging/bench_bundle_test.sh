#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The bundle of pellucid-bench, and the decoder in it, run with their own libraries and need no others than glibc's.
#   bench_bundle_test.sh SOURCE BIN
set -euo pipefail
source=$1 bin=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$source/packaging/bench_bundle.sh" "$bin" "$work/bundle.tar.gz"
tar -C "$work" -xzf "$work/bundle.tar.gz"
bundled=$work/pellucid-bench/pellucid-bench
"$source/tests/packaging/is_self_contained.sh" "$work/pellucid-bench" pellucid-bench pellucid-decode
# A volume, which the decoder reads.
{
    printf 'NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 16 16\nencoding: raw\nendian: little\n'
    printf 'space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n'
    head -c $((16 * 16 * 16 * 4)) /dev/zero | tr '\0' '?'
} >"$work/volume.nrrd"
"$bundled" --suite scaling --volume "$work/volume.nrrd" >"$work/measured"
grep -q 16x16x16 "$work/measured"
"$bundled" --help | grep -q -- --suite
