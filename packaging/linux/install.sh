#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Pellucid for this user, or for all if the superuser runs it. Run by the self-extracting
# archive, from the folder that it unpacked.
#   install.sh [--prefix FOLDER]
# What it makes is written down in FOLDER/share/pellucid/installation, which uninstall.sh reads.
set -eu
umask 022 # the archive's own is 077
say() { echo "install.sh: $*" >&2; }
from=$(cd "$(dirname "$0")" && pwd)
if [ "$(id -u)" = 0 ]; then
    prefix=/opt/pellucid bin=/usr/local/bin data=/usr/local/share
else
    : "${HOME:?install.sh: HOME says nothing}"
    prefix=$HOME/.local/opt/pellucid bin=$HOME/.local/bin data=${XDG_DATA_HOME:-$HOME/.local/share}
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
while [ "$prefix" != "${prefix%/}" ]; do prefix=${prefix%/}; done
# What a menu entry cannot hold, and the list of what is installed.
case $prefix in
    '' | *[\"\`\$\\%]*) say "'$prefix' cannot hold programs: it is the root, or has one of \" \` \$ \\ %; take another by --prefix"; exit 1 ;;
esac
case $prefix$bin$data in
    *'
'*) say "there is a line break in the name of a folder"; exit 1 ;;
esac
record=share/pellucid/installation
is_ours() { [ -f "$1/$record" ] && [ -x "$1/bin/pellucid" ]; }
# Somebody's folder, or program, that is no installation is not replaced.
if [ -e "$prefix" ] && ! is_ours "$prefix" && [ -n "$(ls -A "$prefix" 2>/dev/null || echo a file)" ]; then
    say "$prefix is there already and is not Pellucid"
    exit 1
fi
for program in pellucid pellucid-cli pellucid-uninstall; do
    target=$(readlink "$bin/$program" 2>/dev/null || true)
    case $target in
        "$prefix"/*) continue ;;
        */bin/pellucid | */bin/pellucid-cli | */uninstall.sh)
            other=${target%/bin/*} other=${other%/uninstall.sh}
            if is_ours "$other"; then
                say "Pellucid is installed in $other; remove it by $other/uninstall.sh first"
                exit 1
            fi
            [ -e "$target" ] || continue # a folder that somebody took away
            ;;
    esac
    if [ -e "$bin/$program" ] || [ -L "$bin/$program" ]; then
        say "$bin/$program is there already and is not Pellucid's"
        exit 1
    fi
done

# Whole or not there: the new one takes the old one's place when all of it is copied, and the old
# one comes back if anything fails.
new=$prefix.new old=$prefix.old swapped= done=
if [ ! -e "$prefix" ] && is_ours "$old"; then # killed at the wrong moment
    mv "$old" "$prefix"
fi
remove_old() { [ ! -e "$old" ] || sh "$from/uninstall.sh" --inside "$old"; }
if is_ours "$prefix" && is_ours "$old"; then # or a moment later
    remove_old
fi
if [ -e "$old" ]; then
    say "$old is in the way; somebody put something into it"
    exit 1
fi
rm -rf "$new"
finish() {
    [ -z "$done" ] || return 0
    rm -rf "$new"
    if is_ours "$old"; then
        rm -rf "$prefix"
        mv "$old" "$prefix"
    elif [ -f "$prefix/$record" ] && [ -n "$swapped" ]; then
        sh "$prefix/uninstall.sh" --quiet || true
    else
        printf %s "$written" | sed 's/^folder //' | sort -r | while IFS= read -r path; do rmdir "$path" || true; done
    fi
    say "Pellucid was not installed; all is as before"
}
trap finish EXIT
trap 'exit 130' INT TERM HUP

written= # FOLDER and FILE lines of the record
note() {
    written="$written$1 $2
"
}
# Makes a folder and notes those that were not there, the outermost first.
make_folder() {
    [ ! -d "$1" ] || return 0
    make_folder "$(dirname "$1")"
    mkdir "$1"
    note folder "$1"
}
make_folder "$(dirname "$prefix")"
why=$(cp -R "$from" "$new" 2>&1) || { say "$(printf '%s\n' "$why" | head -n 1)"; exit 1; }
chmod -R u+rwX,go+rX "$new"
rm -f "$new/install.sh"
mkdir -p "$new/share/pellucid"
{
    echo "prefix $prefix"
    echo "data $data"
    (cd "$new" && find . ! -type d) | sed 's/^\./inside /' | sort
    # What an earlier installation made is this one's.
    [ ! -f "$prefix/$record" ] || grep '^folder ' "$prefix/$record" || true
    printf %s "$written"
} >"$new/$record"
if is_ours "$prefix"; then
    mv "$prefix" "$old"
elif [ -e "$prefix" ]; then
    rmdir "$prefix"
fi
mv "$new" "$prefix"
swapped=yes

# Written down before it is made: what fails half way can be taken back.
keep() { # FROM TO
    written=
    make_folder "$(dirname "$2")"
    note file "$2"
    printf %s "$written" >>"$prefix/$record"
    rm -f "$2"
    if [ "$1" = link ]; then ln -s "$prefix/$3" "$2"; else cp "$1" "$2"; fi
}
desktop=share/applications/org.pellucid.Pellucid.desktop
keep link "$bin/pellucid" bin/pellucid
keep link "$bin/pellucid-cli" bin/pellucid-cli
keep link "$bin/pellucid-uninstall" uninstall.sh
entry=$prefix/bin/pellucid awk '/^Exec=pellucid/ { print "Exec=\"" ENVIRON["entry"] "\"" substr($0, 14); next } { print }' \
    "$prefix/$desktop" >"$prefix/share/pellucid/menu-entry"
echo "inside /share/pellucid/menu-entry" >>"$prefix/$record"
keep "$prefix/share/pellucid/menu-entry" "$data/applications/org.pellucid.Pellucid.desktop"
keep "$prefix/share/mime/packages/pellucid.xml" "$data/mime/packages/pellucid.xml"
keep "$prefix/share/bash-completion/completions/pellucid-cli" "$data/bash-completion/completions/pellucid-cli"
for size in "$prefix"/share/icons/hicolor/*; do
    for icon in "$size"/apps/*; do
        keep "$icon" "$data${icon#"$prefix/share"}"
    done
done
update-desktop-database -q "$data/applications" 2>/dev/null || true
update-mime-database "$data/mime" 2>/dev/null || true
done=yes
remove_old || true
[ ! -e "$old" ] || say "what somebody put into the former folder is in $old"
echo "Pellucid is installed in $prefix; it is in the menu, and as: $bin/pellucid"
case :$PATH: in
    *:"$bin":*) ;;
    *) echo "($bin is not in PATH)" ;;
esac
echo "To remove it: $bin/pellucid-uninstall"
