#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Brings the files of translations in a folder up to date with the texts of the sources.
# Usage: update.sh TARGET_FOLDER [-silent]
set -euo pipefail
target=$(realpath "$1")
options=("${@:2}")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# lupdate knows the macros of Qt only.
grep -rh --include=reasons.h '^ *PELLUCID_REASON(' app core gpu ui >"$scratch/reasons"
sed -n 's/^PELLUCID_REASON([A-Za-z0-9]*, \(".*"\))$/QT_TRANSLATE_NOOP("Reasons", \1);/p' "$scratch/reasons" >"$scratch/reasons.cpp"
if (($(wc -l <"$scratch/reasons.cpp") != $(wc -l <"$scratch/reasons"))); then
    echo 'reasons.h: each reason takes one line: PELLUCID_REASON(name, "English")' >&2
    exit 1
fi

update() { # LANGUAGE OPTION...
    /usr/lib/qt6/bin/lupdate "${options[@]}" -I . -no-obsolete -locations none -source-language en -target-language "$@" \
        ui "$scratch/reasons.cpp" -ts "$target/pellucid_$1.ts"
}
update zh_TW
update en -pluralonly
