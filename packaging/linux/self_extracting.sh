#!/usr/bin/env bash
# Packs a folder that runs by itself (bundle.sh) into a program that installs it.
#   self_extracting.sh FOLDER OUT.run     SOURCE_DATE_EPOCH: of everything in it
set -euo pipefail
folder=$1 out=$2
umask 022
# gzip without a time: the same folder gives the same file.
GZIP=-n makeself --quiet --nox11 --gzip --packaging-date "$(LC_ALL=C date -u -d "@$SOURCE_DATE_EPOCH")" \
    --tar-quietly --tar-extra "--sort=name --mtime=@$SOURCE_DATE_EPOCH --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw" \
    "$folder" "$out" "Pellucid" ./install.sh 2>/dev/null
