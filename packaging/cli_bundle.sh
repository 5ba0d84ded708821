#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs pellucid-cli and the programs that it starts, with every library that they need (see copy_programs.sh), into a
# program that unpacks them: for machines without a window, such as the nodes of a cluster.
#   cli_bundle.sh BIN OUT     makes OUT/pellucid-cli-VERSION-linux-x86_64.run from the programs in BIN
#                             SOURCE_DATE_EPOCH: the time of all files in it
set -euo pipefail
bin=$1 out=$2
max_megabytes=60
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

version=$("$bin/pellucid-cli" --version | awk '{print $2}')
name=pellucid-cli-$version
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/bundle/$name
"$here/copy_programs.sh" "$bin" "$tree" pellucid-cli pellucid-net
documents=$tree/share/doc/pellucid # as the packages have it
mkdir -p "$documents"
cp "$here/../LICENSE" "$here/linux/copyright" "$documents"
cp -R "$here/../resources/manual" "$documents"
cp "$here/../resources/CONFORMANCE.md" "$here/../resources/recipe.schema.json" "$documents"
cp -R "$here/slurm" "$here/orthanc" "$documents"
"$here/linux/inventory.py" "$tree" "$version" "$documents/licences" "$documents/pellucid.spdx.json" >/dev/null
# unpack.sh compares a folder that exists with this list.
sums=$(cd "$tree" && find . -type f | LC_ALL=C sort | xargs -d '\n' sha256sum)
echo "$sums" >"$tree/share/pellucid/contents"
install -m 755 "$here/linux/unpack.sh" "$work/bundle"

run=$out/$name-linux-$(uname -m).run
"$here/linux/self_extracting.sh" "$work/bundle" "$run" "$name" ./unpack.sh \
    "Unpacks pellucid-cli into FOLDER, by default ./$name: sh $(basename "$run") [FOLDER]"
megabytes=$(($(stat -c %s "$run") / 1000000))
if ((megabytes >= max_megabytes)); then
    echo "cli_bundle: $run has $megabytes MB; the limit is $max_megabytes MB" >&2
    exit 1
fi
echo "cli_bundle: $run, $megabytes MB"
