#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Pellucid for this user, or for all if the superuser runs it. Run by the self-extracting
# archive, from the folder that it unpacked.
#   install.sh [--prefix FOLDER]
# Whole or not there: all is copied beside FOLDER and takes its place at once; what fails, or is
# stopped, later on is taken back. FOLDER/share/pellucid/installation lists what there is of it, in
# FOLDER (inside) and elsewhere (link, file, folder): it is complete before anything is made elsewhere,
# and uninstall.sh reads it.
set -eu
umask 022 # the archive's own is 077
say() { echo "install.sh: $*" >&2; }
refuse() { say "$*"; exit 1; }
tab=$(printf '\t')
from=$(cd "$(dirname "$0")" && pwd)
[ -d "${HOME:-}" ] || refuse "HOME is not a folder: '${HOME:-}'"
if [ "$(id -u)" = 0 ]; then
    prefix=/opt/pellucid bin=/usr/local/bin data=/usr/local/share
else
    prefix=$HOME/.local/opt/pellucid bin=$HOME/.local/bin data=$HOME/.local/share
    case ${XDG_DATA_HOME:-} in /*) data=$XDG_DATA_HOME ;; esac # what is relative counts for nothing
fi
while [ $# -gt 0 ]; do
    case $1 in
        --prefix)
            prefix=${2:-}
            [ -n "$prefix" ] || { say "--prefix wants a folder"; exit 2; }
            shift 2
            ;;
        *) say "unknown: $1; it takes --prefix FOLDER"; exit 2 ;;
    esac
done
case $prefix in
    /*) ;;
    *) prefix=${USER_PWD:-$PWD}/$prefix ;; # where the archive was started
esac
prefix=$(readlink -m "$prefix")
# What a menu entry cannot hold, a list of dictionaries, and the list of what is installed.
case $prefix in
    *[\"\`\$\\%:]*) refuse "$prefix cannot hold programs for one of \" \` \$ \\ % : in it; take another by --prefix" ;;
esac
case $prefix$bin$data in
    *"$tab"* | *'
'*) refuse "there is a tabulator or a line break in the name of a folder" ;;
esac
for folder in "$data/pellucid" "${XDG_CONFIG_HOME:-$HOME/.config}/pellucid" "${XDG_CACHE_HOME:-$HOME/.cache}/pellucid" "$bin"; do
    folder=$(readlink -m "$folder")
    case $folder/ in "${prefix%/}"/*) refuse "$prefix is no place for programs: $folder is for something else" ;; esac
    case $prefix/ in "$folder"/*) refuse "$prefix is no place for programs: $folder is for something else" ;; esac
done
record=share/pellucid/installation
is_ours() { [ -f "$1/$record" ]; }
# Somebody's folder, or program, that is no installation is not replaced.
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
        refuse "Pellucid is installed in $other; remove it by $other/uninstall.sh first"
    fi
    [ -L "$link" ] && [ ! -e "$link" ] || refuse "$link already exists and is not Pellucid's"
done

# One at a time: a lock on a folder that is there anyway leaves nothing behind.
if [ "$(id -u)" = 0 ]; then exec 9</; else exec 9<"$HOME"; fi
if command -v flock >/dev/null && ! flock -w 10 9; then
    refuse "another one is installing Pellucid; wait for it"
fi

new=$prefix.new old=$prefix.old state=looking made=
# What earlier ones left that were killed: the former installation waits for its place, or to go.
for rest in "$old" "$old".[0-9]*; do
    is_ours "$rest" || continue
    if [ -e "$prefix" ]; then
        sh "$from/uninstall.sh" --inside "$rest" || true
    else
        mv "$rest" "$prefix"
    fi
done
n=1
while [ -e "$old" ]; do # somebody's files of a former one
    n=$((n + 1)) old=$prefix.old.$n
done
if [ -e "$new" ] && ! rmdir "$new" 2>/dev/null; then
    [ -e "$new/.unpacking" ] || is_ours "$new" || refuse "$new is in the way"
    rm -rf "$new"
fi

# What is made elsewhere, by an installation in FOLDER: kind, from, to. Files of these names in the
# folders of the desktop are Pellucid's, whoever wrote them.
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
# Each in one go: there is the former one or the new one.
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
missing_folders() { # the outermost last
    folder=$(dirname "$1")
    while [ ! -d "$folder" ]; do
        echo "folder $folder"
        folder=$(dirname "$folder")
    done
}

# Nothing of what fails stays; the former installation comes back, and what it has elsewhere.
finish() {
    trap '' INT TERM HUP
    case $state in
        done) return ;;
        looking) ;;
        *)
            if [ $state = copying ]; then
                : # the former one was not touched
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
    say "Pellucid was not installed; all is as before"
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
    # What a former installation has elsewhere, and this one lacks, goes with this one.
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
    [ ! -e "$old" ] || say "what somebody put into the former folder is in $old"
fi
update-desktop-database -q "$data/applications" 2>/dev/null || true
update-mime-database "$data/mime" 2>/dev/null || true
echo "Pellucid is installed in $prefix; it is in the menu, and as: $bin/pellucid"
case :$PATH: in
    *:"$bin":*) ;;
    *) echo "($bin is not in PATH)" ;;
esac
echo "To remove it: $bin/pellucid-uninstall"
