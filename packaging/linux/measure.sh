#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the card and measures this machine, within four minutes. The self-extracting archive (see bench_bundle.sh) runs this
# script from the folder that it unpacked.
#   measure.sh               writes figures.json, report/report.html and gpu_test.txt in ./pellucid-bench
#   measure.sh OPTIONS...    runs pellucid-bench with these options in the current folder
set -eu
umask 022 # the archive runs this with 077
started_in=${USER_PWD:-$PWD}
here=$(cd "$(dirname "$0")" && pwd)
cd "$started_in"
if [ $# -gt 0 ]; then
    exec "$here/pellucid-bench" "$@"
fi
mkdir -p pellucid-bench
cd pellucid-bench
echo "pellucid-bench: tests of the card, at most a minute"
tests=0
timeout 60 "$here/gpu_test" >gpu_test.txt 2>&1 || tests=$?
case $tests in
    0) echo "pellucid-bench: all tests of the card pass" ;;
    124) echo "pellucid-bench: the card is too slow for all tests; gpu_test.txt lists those that ran" ;;
    *)
        echo "pellucid-bench: these tests of the card fail; gpu_test.txt has the details:"
        grep '^\[  FAILED  \].*)$' gpu_test.txt || tail -n 3 gpu_test.txt
        ;;
esac
measured=0
"$here/pellucid-bench" --suite gpu,quick --within 2.5 --json figures.json --report report || measured=$?
echo "pellucid-bench: $PWD/figures.json and report/report.html"
[ "$measured" -ne 0 ] || [ "$tests" -eq 124 ] || measured=$tests
exit "$measured"
