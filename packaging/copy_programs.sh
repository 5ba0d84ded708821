#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Copies programs into a folder that runs anywhere: with pellucid-decode, which reads files for them, the dictionaries of
# DICOM, and every library except glibc and OpenGL, which the machine that runs them provides.
#   copy_programs.sh BIN FOLDER PROGRAM...     each PROGRAM is the name of a file in BIN
set -euo pipefail
bin=$1 folder=$2
shift 2
programs=(pellucid-decode "$@")

libraries=$(cd "$bin" && for program in "${programs[@]}"; do ldd "./$program"; done | sort -u)
if grep 'not found' <<<"$libraries" >&2; then
    exit 1
fi
mkdir -p "$folder/lib" "$folder/share/pellucid"
while read -r name _ path _; do
    [[ $path == /* ]] || continue
    case $name in
        libc.so.* | libm.so.* | libmvec.so.* | libdl.so.* | librt.so.* | libpthread.so.* | libresolv.so.*) ;;
        libGL* | libEGL* | libOpenGL*) ;;
        *) install -m 644 "$path" "$folder/lib/$name" ;;
    esac
done <<<"$libraries"
for program in "${programs[@]}"; do
    strip -o "$folder/$program" "$bin/$program"
    # DT_RPATH, the old tag, also applies to the libraries' own dependencies. CMake's BUILD_RPATH will not do: it ends in
    # a colon, and the loader takes the empty name after it for the current folder.
    patchelf --force-rpath --set-rpath "\$ORIGIN/lib" "$folder/$program"
done
found=$("$(dirname "${BASH_SOURCE[0]}")/dictionaries.sh" "$bin/pellucid-decode")
mapfile -t dictionaries <<<"$found"
install -m 644 "${dictionaries[@]}" "$folder/share/pellucid/"
