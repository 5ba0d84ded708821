#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Pellucid for this user, or for all if the superuser runs it. Run by the self-extracting
# archive, from the folder that it unpacked.
#   install.sh [--prefix FOLDER]
set -eu
from=$(cd "$(dirname "$0")" && pwd)
if [ "$(id -u)" = 0 ]; then
    prefix=/opt/pellucid bin=/usr/local/bin data=/usr/local/share
else
    prefix=$HOME/.local/opt/pellucid bin=$HOME/.local/bin data=${XDG_DATA_HOME:-$HOME/.local/share}
fi
while [ $# -gt 0 ]; do
    case $1 in
        --prefix) prefix=${2:?--prefix wants a folder}; shift 2 ;;
        *) echo "install.sh: unknown: $1; it takes --prefix FOLDER" >&2; exit 2 ;;
    esac
done
case $prefix in
    /*) ;;
    *) prefix=$PWD/$prefix ;;
esac
# Somebody's folder that is no installation is not replaced.
if [ -e "$prefix" ] && [ ! -x "$prefix/uninstall.sh" ]; then
    if [ -n "$(ls -A "$prefix" 2>/dev/null)" ]; then
        echo "install.sh: $prefix is there already and is not Pellucid" >&2
        exit 1
    fi
fi
# Whole or not there: the new one takes the old one's place when all of it is copied.
new=$prefix.new.$$
trap 'rm -rf "$new"' EXIT
mkdir -p "$(dirname "$prefix")"
cp -R "$from" "$new"
rm -f "$new/install.sh"
desktop=$data/applications/org.pellucid.Pellucid.desktop
mime=$data/mime/packages/pellucid.xml
cat >"$new/uninstall.sh" <<TEXT
#!/bin/sh
# Removes Pellucid; presets, the study library and settings stay.
rm -f '$bin/pellucid' '$bin/pellucid-cli' '$bin/pellucid-uninstall' '$desktop' '$mime'
rm -f '$data'/icons/hicolor/*/apps/pellucid.png '$data/icons/hicolor/scalable/apps/pellucid.svg'
rm -f '$data/bash-completion/completions/pellucid-cli'
rm -rf '$prefix'
update-desktop-database -q '$data/applications' 2>/dev/null || true
update-mime-database '$data/mime' 2>/dev/null || true
echo "Pellucid is removed. Presets and studies are kept in \${XDG_DATA_HOME:-\$HOME/.local/share}/pellucid"
TEXT
chmod 755 "$new/uninstall.sh"
if [ -e "$prefix" ]; then
    mv "$prefix" "$new.old"
fi
mv "$new" "$prefix"
rm -rf "$new.old"

mkdir -p "$bin" "$data/applications" "$data/mime/packages" "$data/bash-completion/completions"
ln -sf "$prefix/bin/pellucid" "$bin/pellucid"
ln -sf "$prefix/bin/pellucid-cli" "$bin/pellucid-cli"
ln -sf "$prefix/uninstall.sh" "$bin/pellucid-uninstall"
sed "s|^Exec=pellucid|Exec=\"$prefix/bin/pellucid\"|" "$prefix/share/applications/org.pellucid.Pellucid.desktop" >"$desktop"
cp "$prefix/share/mime/packages/pellucid.xml" "$mime"
cp "$prefix/share/bash-completion/completions/pellucid-cli" "$data/bash-completion/completions/"
(cd "$prefix/share/icons/hicolor" && find . -type f) | while read -r icon; do
    mkdir -p "$data/icons/hicolor/$(dirname "$icon")"
    cp "$prefix/share/icons/hicolor/$icon" "$data/icons/hicolor/$icon"
done
update-desktop-database -q "$data/applications" 2>/dev/null || true
update-mime-database "$data/mime" 2>/dev/null || true
echo "Pellucid is installed in $prefix; it is in the menu, and as: $bin/pellucid"
case :$PATH: in
    *:"$bin":*) ;;
    *) echo "($bin is not in PATH)" ;;
esac
echo "To remove it: $bin/pellucid-uninstall"
