#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Copies Pellucid's command line into a folder. The self-extracting archive (see cli_bundle.sh) runs this script from the
# folder that it unpacked.
#   unpack.sh [FOLDER]     default: a folder with the name and the version, in the current folder
# FOLDER is complete or absent: everything is copied to a folder beside it, which then becomes FOLDER at once. Therefore all
# tasks of a job may unpack into the same folder: one copies, the others find its files complete.
set -eu
umask 022 # the archive runs this with 077
say() { echo "pellucid-cli: $*"; }
refuse() { say "$*" >&2; exit 1; }
started_in=${USER_PWD:-$PWD}
cd "$(dirname "$0")"
name=$(echo pellucid-cli-*) contents=share/pellucid/contents
to=${1:-$name}
if [ $# -gt 1 ] || [ "${to#-}" != "$to" ]; then
    say "the only argument is a folder" >&2
    exit 2
fi
case $to in
    /*) ;;
    *) to=$started_in/$to ;;
esac
to=$(readlink -m "$to")
is_complete() {
    [ "$(cat "$to/$contents" 2>/dev/null)" = "$(cat "$name/$contents")" ] &&
        (cd "$to" && sha256sum -c "$contents" >/dev/null 2>&1)
}
is_taken() { [ -e "$to" ] && [ -n "$(ls -A "$to" 2>/dev/null || echo a file)" ]; }
leave_complete() {
    if is_complete; then
        say "is already in $to"
        exit
    fi
}
leave_complete
# The caller would remain in the folder that is replaced.
[ "$to" != "$(readlink -m "$started_in")" ] || refuse "choose another folder than the current one"
if is_taken; then
    leave_complete # since the last look, another task may have been faster
    refuse "$to already exists with other contents; remove it, or choose another folder"
fi
mkdir -p "$(dirname "$to")"
new=$(mktemp -d "$to.XXXXXX") || refuse "nothing can be written beside $to"
trap 'rm -rf "$new"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
chmod 755 "$new"
cp -R "$name/." "$new"
"$new/pellucid-cli" --version >/dev/null || refuse "does not run on this machine, for the reason above"
# Another task may have been faster.
mv -T "$new" "$to" 2>/dev/null || is_complete || refuse "$to cannot be replaced"
say "unpacked into $to"
