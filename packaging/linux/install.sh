#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Pellucid for this user, or for all users if root runs it. The self-extracting archive runs this script from
# the folder that it unpacked.
#   install.sh [--prefix FOLDER]
# An installation is complete or absent: everything is copied to a folder beside FOLDER, which then replaces FOLDER at
# once. If a later step fails or is interrupted, everything is undone. The record FOLDER/share/pellucid/installation
# lists all that is installed, in FOLDER (inside) and elsewhere (link, file, folder). It is complete before anything is
# created elsewhere, and uninstall.sh reads it.
set -eu
umask 022 # the archive runs this with 077
say() { echo "install.sh: $*" >&2; }
refuse() { say "$*"; exit 1; }
tab=$(printf '\t')
from=$(cd "$(dirname "$0")" && pwd)
[ -d "${HOME:-}" ] || refuse "HOME is not a folder: '${HOME:-}'"
if [ "$(id -u)" = 0 ]; then
    prefix=/opt/pellucid bin=/usr/local/bin data=/usr/local/share
else
    prefix=$HOME/.local/opt/pellucid bin=$HOME/.local/bin data=$HOME/.local/share
    case ${XDG_DATA_HOME:-} in /*) data=$XDG_DATA_HOME ;; esac # the specification says to ignore relative paths
fi
while [ $# -gt 0 ]; do
    case $1 in
        --prefix)
            prefix=${2:-}
            [ -n "$prefix" ] || { say "--prefix needs a folder"; exit 2; }
            shift 2
            ;;
        *) say "unknown: $1; the only option is --prefix FOLDER"; exit 2 ;;
    esac
done
case $prefix in
    /*) ;;
    *) prefix=${USER_PWD:-$PWD}/$prefix ;; # relative to where the archive was started
esac
prefix=$(readlink -m "$prefix")
# Characters that a menu entry, a list of dictionaries or the record cannot contain.
case $prefix in
    *[\"\`\$\\%:]*) refuse "$prefix cannot hold programs: its name contains one of \" \` \$ \\ % : ; choose another folder with --prefix" ;;
esac
case $prefix$bin$data in
    *"$tab"* | *'
'*) refuse "the name of a folder contains a tab or a line break" ;;
esac
for folder in "$data/pellucid" "${XDG_CONFIG_HOME:-$HOME/.config}/pellucid" "${XDG_CACHE_HOME:-$HOME/.cache}/pellucid" "$bin"; do
    folder=$(readlink -m "$folder")
    case $folder/ in "${prefix%/}"/*) refuse "$prefix is no place for programs: it overlaps $folder, which has another use" ;; esac
    case $prefix/ in "$folder"/*) refuse "$prefix is no place for programs: it overlaps $folder, which has another use" ;; esac
done
record=share/pellucid/installation
is_ours() { [ -f "$1/$record" ]; }
# Never replace a folder or a program that is not an installation of Pellucid.
if [ -e "$prefix" ] && ! is_ours "$prefix" && [ -n "$(ls -A "$prefix" 2>/dev/null || echo a file)" ]; then
    refuse "$prefix already exists and is not Pellucid"
fi
for program in pellucid pellucid-cli pellucid-uninstall; do
    link=$bin/$program
    [ -L "$link" ] || [ -e "$link" ] || continue
    target=$(readlink -m "$link")
    case $target in "$prefix"/*) [ ! -L "$link" ] || continue ;; esac
    other=${target%/bin/*} other=${other%/uninstall.sh}
    if [ -L "$link" ] && is_ours "$other"; then
        refuse "Pellucid is already installed in $other; remove it first with $other/uninstall.sh"
    fi
    [ -L "$link" ] && [ ! -e "$link" ] || refuse "$link already exists and is not Pellucid's"
done

# Only one installer runs at a time. Locking a folder that exists anyway leaves no lock file behind.
if [ "$(id -u)" = 0 ]; then exec 9</; else exec 9<"$HOME"; fi
if command -v flock >/dev/null && ! flock -w 10 9; then
    refuse "another process is installing Pellucid; wait until it ends"
fi

new=$prefix.new old=$prefix.old state=looking made=
# An installer that was killed may have left the former installation in $old: move it back, or remove it if a new one is
# in its place.
for rest in "$old" "$old".[0-9]*; do
    is_ours "$rest" || continue
    if [ -e "$prefix" ]; then
        sh "$from/uninstall.sh" --inside "$rest" || true
    else
        mv "$rest" "$prefix"
    fi
done
n=1
while [ -e "$old" ]; do # it contains files that are not Pellucid's
    n=$((n + 1)) old=$prefix.old.$n
done
if [ -e "$new" ] && ! rmdir "$new" 2>/dev/null; then
    [ -e "$new/.unpacking" ] || is_ours "$new" || refuse "$new is in the way"
    rm -rf "$new"
fi

# Lists what an installation in FOLDER creates elsewhere: kind, source, target. Files with these names in the desktop's
# folders count as Pellucid's.
elsewhere() { # FOLDER
    printf "%s$tab%s$tab%s\n" link "$prefix/bin/pellucid" "$bin/pellucid" link "$prefix/bin/pellucid-cli" "$bin/pellucid-cli" \
        file "$1/share/pellucid/menu-entry" "$data/applications/org.pellucid.Pellucid.desktop" \
        file "$1/share/mime/packages/pellucid.xml" "$data/mime/packages/pellucid.xml" \
        file "$1/share/bash-completion/completions/pellucid-cli" "$data/bash-completion/completions/pellucid-cli"
    (cd "$1/share/icons/hicolor" && find . -type f) | sort | while IFS= read -r icon; do
        printf "file$tab%s$tab%s\n" "$1/share/icons/hicolor/${icon#./}" "$data/icons/hicolor/${icon#./}"
    done
    printf "%s$tab%s$tab%s\n" link "$prefix/uninstall.sh" "$bin/pellucid-uninstall"
}
# Each is replaced atomically: either the former or the new one exists.
make_elsewhere() { # FOLDER
    elsewhere "$1" | while IFS=$tab read -r kind source to; do
        mkdir -p "$(dirname "$to")" || exit 1
        rm -f "$to.pellucid-new"
        case $kind in
            link) ln -s "$source" "$to.pellucid-new" ;;
            file) cp "$source" "$to.pellucid-new" ;;
        esac && mv -fT "$to.pellucid-new" "$to" || { rm -f "$to.pellucid-new"; exit 1; }
    done
}
missing_folders() { # outermost last
    folder=$(dirname "$1")
    while [ ! -d "$folder" ]; do
        echo "folder $folder"
        folder=$(dirname "$folder")
    done
}

# A failure leaves nothing behind; the former installation is restored, with what it has elsewhere.
finish() {
    trap '' INT TERM HUP
    case $state in
        done) return ;;
        looking) ;;
        *)
            if [ $state = copying ]; then
                : # the former installation was not touched
            elif [ ! -e "$new" ] && is_ours "$prefix" && is_ours "$old"; then
                grep -vxF -f "$old/$record" "$prefix/$record" | sh "$from/uninstall.sh" --listed "$prefix" || true
                mv "$prefix" "$new"
                mv "$old" "$prefix"
                make_elsewhere "$prefix" || true
            elif [ ! -e "$new" ] && is_ours "$prefix"; then
                sh "$prefix/uninstall.sh" --quiet || true
            elif [ ! -e "$prefix" ] && is_ours "$old"; then
                mv "$old" "$prefix"
            fi
            rm -rf "$new"
            printf %s "$made" | while IFS= read -r folder; do rmdir "${folder#folder }" 2>/dev/null || true; done
            ;;
    esac
    say "Pellucid was not installed; nothing has changed"
}
trap finish EXIT
trap 'exit 130' INT TERM HUP

made="$(missing_folders "$prefix")
"
state=copying
why=$(mkdir -p "$(dirname "$prefix")" 2>&1 && mkdir "$new" 2>&1) || refuse "$why"
: >"$new/.unpacking"
why=$(cp -R "$from/." "$new" 2>&1) || refuse "$(printf '%s\n' "$why" | head -n 1)"
chmod -R u+rwX,go+rX "$new"
rm -f "$new/install.sh"
mkdir -p "$new/share/pellucid"
entry=$prefix/bin/pellucid awk '/^Exec=pellucid/ { print "Exec=\"" ENVIRON["entry"] "\"" substr($0, 14); next } { print }' \
    "$new/share/applications/org.pellucid.Pellucid.desktop" >"$new/share/pellucid/menu-entry"
{
    # Uninstalling also removes what only the former installation has elsewhere.
    if is_ours "$prefix"; then grep -E '^(data|link|file|folder) ' "$prefix/$record"; fi
    echo "data $data"
    elsewhere "$new" | while IFS=$tab read -r kind _ to; do
        echo "$kind $to"
        missing_folders "$to"
    done
    printf %s "$made"
    (cd "$new" && find . ! -type d ! -name .unpacking) | sed 's/^\./inside /'
    echo "prefix $prefix"
} | sort -u >"$new/.record"
mv "$new/.record" "$new/$record"
rm "$new/.unpacking"
state=swapping
if is_ours "$prefix"; then
    mv -T "$prefix" "$old"
elif [ -e "$prefix" ]; then
    rmdir "$prefix"
fi
mv -T "$new" "$prefix"
make_elsewhere "$prefix"
state=done
trap '' INT TERM HUP
if is_ours "$old"; then
    elsewhere "$prefix" | while IFS=$tab read -r kind _ to; do echo "$kind $to"; done |
        grep -vxF -f - "$prefix/$record" | grep -E '^(link|file) ' | sh "$prefix/uninstall.sh" --listed "$prefix" || true
    sh "$prefix/uninstall.sh" --inside "$old" || true
    [ ! -e "$old" ] || say "files in the former folder that are not Pellucid's are now in $old"
fi
update-desktop-database -q "$data/applications" 2>/dev/null || true
update-mime-database "$data/mime" 2>/dev/null || true
echo "Pellucid is installed in $prefix. Start it from the menu, or as: $bin/pellucid"
case :$PATH: in
    *:"$bin":*) ;;
    *) echo "($bin is not in PATH)" ;;
esac
echo "To remove it: $bin/pellucid-uninstall"
