#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs a folder into a program that unpacks it to a temporary folder and runs a script there.
#   self_extracting.sh FOLDER OUT.run TITLE SCRIPT HELP     SCRIPT: relative to FOLDER; HELP: the first line of --help
#                                                           SOURCE_DATE_EPOCH: the time of all files in it
set -euo pipefail
folder=$(realpath "$1") out=$(realpath -m "$2") title=$3 script=$4 help=$5
umask 022
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# makeself writes its command line and the unpacked size into the file. To make both the same everywhere, give it
# relative names and a du that counts bytes instead of disk blocks.
cp -a "$folder" "$scratch/pellucid" # the folder that it unpacks to
mkdir "$scratch/bin"
printf '#!/bin/sh\nexec %s --apparent-size "$@"\n' "$(command -v du)" >"$scratch/bin/du"
chmod 755 "$scratch/bin/du"
printf '%s\n\n' "$help" >"$scratch/help"
cd "$scratch"
# gzip without a timestamp: the same folder gives the same file. Level 9 takes four times as long as 6 to save half a percent.
GZIP=-n PATH=$scratch/bin:$PATH makeself --quiet --nox11 --gzip --complevel 6 --packaging-date "$(LC_ALL=C date -u -d "@$SOURCE_DATE_EPOCH")" \
    --tar-quietly --tar-extra "--sort=name --mtime=@$SOURCE_DATE_EPOCH --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw" \
    --help-header ./help pellucid pellucid.run "$title" sh "$script" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
mv pellucid.run "$out"
