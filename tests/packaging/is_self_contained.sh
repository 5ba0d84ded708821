#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Programs in FOLDER need no other libraries than those in it and glibc's, and have DICOM's dictionaries.
#   is_self_contained.sh FOLDER PROGRAM...
set -euo pipefail
folder=$(realpath "$1")
shift
cd "$folder"
for program; do
    libraries=$(ldd "$folder/$program")
    if grep 'not found' <<<"$libraries" >&2; then
        exit 1
    fi
    foreign=$(sed -nE 's#.* => (/.*) \(0x.*#\1#p' <<<"$libraries" | grep -vF "$folder/lib/" |
        grep -Ev '/lib(c|m|mvec|dl|rt|pthread|resolv)\.so' || true)
    if [[ -n $foreign ]]; then
        echo "$program takes from the system: $foreign" >&2
        exit 1
    fi
    # An empty name, as after a colon, would be the current folder.
    path=$(readelf -d "$program" | sed -nE 's/.*\(RPATH\).*\[(.*)\]/\1/p')
    if [[ $path != '$ORIGIN/lib' ]]; then
        echo "$program looks for libraries in '$path'" >&2
        exit 1
    fi
done
[[ -s share/pellucid/dicom.dic && -s share/pellucid/private.dic ]]
