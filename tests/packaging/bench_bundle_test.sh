#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The bundle of pellucid-bench, and the decoder in it, run with their own libraries and need no others than glibc's.
#   bench_bundle_test.sh SOURCE PROGRAM
set -euo pipefail
source=$1 program=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$source/packaging/bench_bundle.sh" "$program" "$work/bundle.tar.gz"
tar -C "$work" -xzf "$work/bundle.tar.gz"
bundled=$work/pellucid-bench/pellucid-bench
for file in "$bundled" "$work/pellucid-bench/pellucid-decode"; do
    if ldd "$file" | grep 'not found' >&2; then
        exit 1
    fi
done
foreign=$(ldd "$bundled" "$work/pellucid-bench/pellucid-decode" | awk '$3 ~ /^\// {print $3}' | grep -v "^$work" |
    grep -Ev '/lib(c|m|dl|rt|pthread|resolv)\.so' || true)
if [[ -n $foreign ]]; then
    echo "the bundle takes from the system: $foreign" >&2
    exit 1
fi
[[ -s $work/pellucid-bench/share/pellucid/dicom.dic && -s $work/pellucid-bench/share/pellucid/private.dic ]]
# A volume, which the decoder reads.
{
    printf 'NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 16 16\nencoding: raw\nendian: little\n'
    printf 'space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n'
    head -c $((16 * 16 * 16 * 4)) /dev/zero | tr '\0' '?'
} >"$work/volume.nrrd"
"$bundled" --suite scaling --volume "$work/volume.nrrd" >"$work/measured"
grep -q 16x16x16 "$work/measured"
"$bundled" --help | grep -q -- --suite
