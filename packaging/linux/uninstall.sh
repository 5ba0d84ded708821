#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Removes the files that install.sh recorded. It keeps presets, the study library, settings, and files that others put
# beside Pellucid. It names what it cannot remove, and can be run again.
#   uninstall.sh [--quiet]           --quiet: undoes a failed installation, and keeps the cache
#   uninstall.sh --inside FOLDER     only the files in the folder of an installation
#   uninstall.sh --listed PREFIX     only what the standard input lists, in the format of the record
set -eu
say() { echo "pellucid-uninstall: $*" >&2; }
here=$(cd "$(dirname "$(readlink -f "$0")")" && pwd -P)
mode=${1:-all}
case $mode in
    all | --quiet) ;;
    --inside | --listed) here=${2:?} ;;
    *) say "unknown: $1"; exit 2 ;;
esac
record=$here/share/pellucid/installation
[ -f "$record" ] || { say "$here is not an installation of Pellucid"; exit 1; }
if [ ! -w "$here" ] || [ ! -w "$(dirname "$here")" ]; then
    say "you are not allowed to remove $here"
    exit 1
fi
of() { sed -n "s/^$1 //p" "$record"; }
prefix=$(of prefix | head -n 1)

# Reads lines of the record and removes what was created elsewhere, unless a name now belongs to something else.
remove_listed() {
    while read -r kind path; do
        case $kind in
            link)
                [ -L "$path" ] || continue
                case $(readlink "$path") in "$prefix"/*) rm -f "$path" || true ;; esac
                ;;
            file) [ -d "$path" ] || rm -f "$path" || true ;;
        esac
    done
}
remove_folders() { # innermost first; only empty ones
    sed -n 's/^folder //p' | sort -ru | while IFS= read -r path; do rmdir "$path" 2>/dev/null || true; done
}
if [ "$mode" = --listed ]; then
    listed=$(cat)
    printf '%s\n' "$listed" | remove_listed
    printf '%s\n' "$listed" | remove_folders
    exit
fi

remove_inside() { # FOLDER; the record last
    sed -n 's/^inside //p' "$1/share/pellucid/installation" | sed "s|^|./|" | tr '\n' '\0' | (cd "$1" && xargs -0 -r rm -f)
    rm -f "$1/share/pellucid/installation"
    find "$1" -depth -type d -empty -exec rmdir {} \;
}
if [ "$mode" = --inside ]; then
    remove_inside "$here"
    exit
fi

# Files elsewhere belong to the installation at $prefix, not to a copy of it.
if [ "$here" != "$prefix" ] && [ -f "$prefix/share/pellucid/installation" ]; then
    remove_inside "$here"
    echo "This copy is removed; Pellucid in $prefix is kept"
    exit
fi
# The link to this script is removed last of what is elsewhere.
all=$(cat "$record")
printf '%s\n' "$all" | grep -v '/pellucid-uninstall$' | remove_listed
of data | while IFS= read -r data; do
    update-desktop-database -q "$data/applications" 2>/dev/null || true
    [ ! -d "$data/mime/packages" ] || update-mime-database "$data/mime" 2>/dev/null || true
    # Remove the caches that these two programs wrote, unless others use them.
    if of folder | grep -qxF "$data/applications" && [ "$(ls -A "$data/applications" 2>/dev/null)" = mimeinfo.cache ]; then
        rm -f "$data/applications/mimeinfo.cache"
    fi
    if of folder | grep -qxF "$data/mime" && [ -z "$(ls -A "$data/mime/packages" 2>/dev/null)" ]; then
        rm -rf "$data/mime"
    fi
done
if [ "$mode" = all ] && [ "$(id -u)" != 0 ]; then # the cache can be rebuilt
    case ${XDG_CACHE_HOME:-} in
        /*) rm -rf "$XDG_CACHE_HOME/pellucid" ;;
        *) [ -z "${HOME:-}" ] || rm -rf "$HOME/.cache/pellucid" ;;
    esac
fi
left=$(of file | while IFS= read -r path; do [ ! -e "$path" ] || echo "$path"; done)
if [ -n "$left" ]; then
    say "cannot be removed: $(printf '%s' "$left" | tr '\n' ' '); then run $here/uninstall.sh again"
    exit 1
fi
for former in "$here".old "$here".old.[0-9]*; do # left by an upgrade that was killed
    [ ! -f "$former/share/pellucid/installation" ] || remove_inside "$former"
done
remove_inside "$here"
printf '%s\n' "$all" | grep '/pellucid-uninstall$' | remove_listed
printf '%s\n' "$all" | remove_folders
for rest in "$here" "$here".old "$here".old.[0-9]*; do
    [ ! -e "$rest" ] || say "files that are not Pellucid's are kept in $rest"
done
[ "$mode" = --quiet ] || echo "Pellucid is removed. Each user's presets, studies and settings are kept in ~/.local/share/pellucid and ~/.config/pellucid"
