#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs pellucid-bench and the tests of the card, with every library that they need (see copy_programs.sh), into a program
# that measures the machine on which it runs (see linux/measure.sh).
#   bench_bundle.sh BIN TESTS OUT.run     BIN has pellucid-bench and pellucid-decode, TESTS gpu_test
#                                         SOURCE_DATE_EPOCH: the time of all files in it
set -euo pipefail
bin=$1 tests=$2 out=$3
max_megabytes=60
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$(realpath "$bin")"/pellucid-{bench,decode} "$(realpath "$tests")/gpu_test" "$work/bin"
"$here/copy_programs.sh" "$work/bin" "$work/bundle" pellucid-bench gpu_test
install -m 755 "$here/linux/measure.sh" "$work/bundle"
"$here/linux/self_extracting.sh" "$work/bundle" "$out" pellucid-bench ./measure.sh \
    "Measures speed and error on this machine, and tests its card: sh $(basename "$out") [-- OPTIONS of pellucid-bench]"
megabytes=$(($(stat -c %s "$out") / 1000000))
if ((megabytes >= max_megabytes)); then
    echo "bench_bundle: $out has $megabytes MB; the limit is $max_megabytes MB" >&2
    exit 1
fi
echo "bench_bundle: $out, $megabytes MB"
