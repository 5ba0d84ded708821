#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The dictionaries that DCMTK reads by itself, as its library has them inside, a line each.
#   dictionaries.sh PROGRAM     that is linked with DCMTK
set -euo pipefail
library=$(ldd "$1" | awk '$1 ~ /^libdcmdata\./ {print $3}')
mapfile -t found < <(grep -aoE '(/[[:alnum:]/._+-]+\.dic:?)+' "$library" | head -1 | tr ':' '\n')
((${#found[@]} > 0)) || { echo "dictionaries: none in $library" >&2; exit 1; }
ls "${found[@]}"
