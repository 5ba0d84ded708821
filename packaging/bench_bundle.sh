#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs pellucid-bench with every library that it needs, except glibc and OpenGL, which the machine that runs it
# provides. Unpack it anywhere and run pellucid-bench/pellucid-bench.
#   bench_bundle.sh PROGRAM OUT.tar.gz
set -euo pipefail
program=$1 out=$2
max_megabytes=60

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
folder=$work/pellucid-bench
mkdir -p "$folder/lib"
decoder=$(dirname "$program")/pellucid-decode # reads NRRD volumes
strip -o "$folder/pellucid-bench" "$program"
strip -o "$folder/pellucid-decode" "$decoder"
if { ldd "$program"; ldd "$decoder"; } | grep 'not found' >&2; then
    exit 1
fi
{ ldd "$program"; ldd "$decoder"; } | sort -u | while read -r name _ path _; do
    [[ $path == /* ]] || continue
    case $name in
        libc.so.* | libm.so.* | libdl.so.* | librt.so.* | libpthread.so.* | libresolv.so.*) ;;
        libGL* | libEGL* | libOpenGL*) ;;
        *) cp -L "$path" "$folder/lib/$name" ;;
    esac
done
mkdir -p "$folder/share/pellucid"
found=$("$(dirname "${BASH_SOURCE[0]}")/dictionaries.sh" "$decoder")
mapfile -t dictionaries <<<"$found"
cp "${dictionaries[@]}" "$folder/share/pellucid/"
tar -C "$work" -czf "$out" pellucid-bench
megabytes=$(($(stat -c %s "$out") / 1000000))
if ((megabytes >= max_megabytes)); then
    echo "bench_bundle: $out has $megabytes MB; the limit is $max_megabytes MB" >&2
    exit 1
fi
echo "bench_bundle: $out, $megabytes MB"
