#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs a self-contained folder (see bundle.sh) into a program that installs it.
#   self_extracting.sh FOLDER OUT.run     SOURCE_DATE_EPOCH: the time of all files in it
set -euo pipefail
folder=$(realpath "$1") out=$(realpath -m "$2")
umask 022
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# makeself writes its command line and the unpacked size into the file. To make both the same everywhere, give it
# relative names and a du that counts bytes instead of disk blocks.
cp -a "$folder" "$scratch/pellucid" # the folder that it unpacks to
mkdir "$scratch/bin"
printf '#!/bin/sh\nexec %s --apparent-size "$@"\n' "$(command -v du)" >"$scratch/bin/du"
chmod 755 "$scratch/bin/du"
printf 'Installs Pellucid for this user, or for all users if root runs it. Another folder: -- --prefix FOLDER\n\n' >"$scratch/help"
cd "$scratch"
# gzip without a timestamp: the same folder gives the same file.
GZIP=-n PATH=$scratch/bin:$PATH makeself --quiet --nox11 --gzip --packaging-date "$(LC_ALL=C date -u -d "@$SOURCE_DATE_EPOCH")" \
    --tar-quietly --tar-extra "--sort=name --mtime=@$SOURCE_DATE_EPOCH --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw" \
    --help-header ./help pellucid pellucid.run "Pellucid" sh ./install.sh >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
mv pellucid.run "$out"
