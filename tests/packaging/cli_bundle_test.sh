#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The bundle of pellucid-cli unpacks whole or not at all, needs no libraries but glibc's, and renders a batch from there.
# `./dev install-test` runs it in bare systems.
#   cli_bundle_test.sh SOURCE BIN
set -euo pipefail
source=$1 bin=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "cli_bundle_test: $*" >&2; exit 1; }

export SOURCE_DATE_EPOCH=1700000000
"$source/packaging/cli_bundle.sh" "$bin" "$work"
run=$(echo "$work"/pellucid-cli-*-linux-"$(uname -m)".run)
name=$(basename "$run" "-linux-$(uname -m).run")
# Another umask, and copies of the programs elsewhere, which are newer: the same bytes.
mkdir "$work/copies" "$work/again"
cp "$bin"/pellucid-{cli,decode,net} "$work/copies"
(umask 077 && "$source/packaging/cli_bundle.sh" "$work/copies" "$work/again" >/dev/null)
cmp "$run" "$work/again/$(basename "$run")" || fail "another build gives other bytes"
rm -r "$work/again" "$work/copies"

home=$work/home
mkdir "$home"
bare() { (cd "$home" && env -i HOME="$home" PATH=/usr/bin:/bin "$@"); }
unpack() { (umask 077 && bare sh "$run" --quiet "$@" >"$work/output" 2>&1); }
refuses() { # WHY FOLDER
    local code=0
    unpack "$2" || code=$?
    ((code == 1)) || fail "unpacked, in spite of: $1"
    grep -qF "$1" "$work/output" || fail "expected: $1; got: $(cat "$work/output")"
}

# All tasks of a job may unpack into one folder at once.
folder="$home/some where/cli"
tasks=()
for task in 1 2 3; do
    bare sh "$run" --quiet "some where/cli" >"$work/task$task" 2>&1 &
    tasks+=($!)
done
for task in "${tasks[@]}"; do
    wait "$task" || fail "together: $(cat "$work"/task?)"
done
[[ $(ls -A "$home/some where") == cli ]] || fail "together: left behind: $(ls -A "$home/some where")"
refuses "other contents" "some where"
refuses "current one" .
touch "$home/file"
refuses "other contents" file
# A folder that lost a file is not taken for complete.
mv "$folder/share/doc/pellucid/LICENSE" "$home"
refuses "other contents" "$folder"
mv "$home/LICENSE" "$folder/share/doc/pellucid"
unpack "$folder" || fail "a second time: $(cat "$work/output")"
unpack || fail "without a folder: $(cat "$work/output")"
[[ -x $home/$name/pellucid-cli && $(stat -c %a "$home/$name") == 755 ]] || fail "without a folder: $(ls -l "$home")"
unpack one two && fail "two folders are accepted"
unpack -- --one && fail "an option is taken for a folder"

"$source/tests/packaging/is_self_contained.sh" "$folder" pellucid-cli pellucid-decode pellucid-net
for file in LICENSE manual/manual.html licences/libdcmtk17 pellucid.spdx.json; do
    [[ -s $folder/share/doc/pellucid/$file ]] || fail "no $file"
done

cli() { bare "$folder/pellucid-cli" "$@"; }
cli phantom head --kind head --size 48x48x32 >/dev/null
echo '{"recipe": 1, "outputs": [{"view": "front", "size": 64}, {"name": "left", "format": "dicom", "size": 64}]}' >"$home/recipe.json"
cli recipe check recipe.json >/dev/null
cli batch recipe.json head --out out
for file in front.png left.dcm done.json; do
    [[ -s $(echo "$home"/out/*/$file) ]] || fail "no $file: $(ls -R "$home/out")"
done
# A port where nothing answers: pellucid-net starts and reports it.
cli server add nobody --dicom NOBODY@127.0.0.1:1 >/dev/null
code=0
cli echo nobody >"$work/output" 2>&1 || code=$?
((code == 6)) || fail "pellucid-net: $(cat "$work/output")"
