#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Removes Pellucid, as install.sh wrote down what it made; presets, the study library and settings
# stay, and so does what others put beside it.
#   uninstall.sh [--quiet]
#   uninstall.sh --inside FOLDER     only the files of the installation that FOLDER was
set -eu
say() { echo "pellucid-uninstall: $*" >&2; }
here=$(cd "$(dirname "$(readlink -f "$0")")" && pwd)
only= quiet=
case ${1:-} in
    '') ;;
    --quiet) quiet=yes ;;
    --inside) here=${2:?} only=yes ;;
    *) say "unknown: $1"; exit 2 ;;
esac
record=$here/share/pellucid/installation
[ -f "$record" ] || { say "$here is no installation of Pellucid"; exit 1; }
if [ ! -w "$here" ] || [ ! -w "$(dirname "$here")" ]; then
    say "$here is not yours to remove"
    exit 1
fi
of() { sed -n "s/^$1 //p" "$record"; }
prefix=$(of prefix) data=$(of data)

if [ -z "$only" ]; then
    of file | while IFS= read -r path; do
        # Somebody else's program may have taken a name since.
        if [ -L "$path" ]; then
            case $(readlink "$path") in "$prefix"/*) ;; *) continue ;; esac
        fi
        rm -f "$path"
    done
    update-desktop-database -q "$data/applications" 2>/dev/null || true
    update-mime-database "$data/mime" 2>/dev/null || true
    # Lists that the two make, where nobody else had any.
    if of folder | grep -qxF "$data/applications" && [ "$(ls -A "$data/applications")" = mimeinfo.cache ]; then
        rm -f "$data/applications/mimeinfo.cache"
    fi
    if of folder | grep -qxF "$data/mime" && [ -z "$(ls -A "$data/mime/packages" 2>/dev/null)" ]; then
        rm -rf "$data/mime"
    fi
    if [ "$(id -u)" != 0 ] && [ -n "${HOME:-}" ]; then
        rm -rf "${XDG_CACHE_HOME:-$HOME/.cache}/pellucid" # can be made again
    fi
fi
folders=$(of folder)
(of inside; echo "/share/pellucid/installation") | while IFS= read -r path; do rm -f "$here$path"; done
find "$here" -depth -type d -empty -exec rmdir {} \;
if [ -z "$only" ]; then
    # The innermost first, and none that others use.
    printf '%s\n' "$folders" | sort -ru | while IFS= read -r path; do
        [ -z "$path" ] || rmdir "$path" 2>/dev/null || true
    done
    [ ! -e "$here" ] || say "what is not of Pellucid stays in $here"
    [ -n "$quiet" ] || echo "Pellucid is removed. Presets and studies are kept in ~/.local/share/pellucid, settings in ~/.config/pellucid"
fi
