#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Lists the dictionary files whose paths are compiled into DCMTK, one per line.
#   dictionaries.sh PROGRAM     PROGRAM is linked with DCMTK
set -euo pipefail
library=$(ldd "$1" | awk '$1 ~ /^libdcmdata\./ {print $3}')
mapfile -t found < <(grep -aoE '(/[[:alnum:]/._+-]+\.dic:?)+' "$library" | head -1 | tr ':' '\n')
((${#found[@]} > 0)) || { echo "dictionaries: none in $library" >&2; exit 1; }
ls "${found[@]}"
