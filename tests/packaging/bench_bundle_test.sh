#!/usr/bin/env bash
# The bundle of pellucid-bench runs with its own libraries and needs no others than glibc's.
#   bench_bundle_test.sh SOURCE PROGRAM
set -euo pipefail
source=$1 program=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$source/packaging/bench_bundle.sh" "$program" "$work/bundle.tar.gz"
tar -C "$work" -xzf "$work/bundle.tar.gz"
bundled=$work/pellucid-bench/pellucid-bench
foreign=$(ldd "$bundled" | awk '$3 ~ /^\// {print $3}' | grep -v "^$work" |
    grep -Ev '/lib(c|m|dl|rt|pthread|resolv)\.so' || true)
if [[ -n $foreign ]]; then
    echo "the bundle takes from the system: $foreign" >&2
    exit 1
fi
if ldd "$bundled" | grep -q 'not found'; then
    ldd "$bundled" >&2
    exit 1
fi
"$bundled" --help | grep -q -- --suite
