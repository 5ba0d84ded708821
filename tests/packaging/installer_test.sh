#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The installer's scripts with a program of a few lines in the place of Pellucid: what they make goes
# again, to the last folder, and what is somebody's stays. The whole packages are tried in bare
# systems by `./dev install-test`.
#   installer_test.sh SOURCE
set -euo pipefail
linux=$(realpath "$1")/packaging/linux
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "installer_test: $*" >&2; exit 1; }

# As the archive unpacks it; VERSION is a file that only this one has.
unpacked() { # VERSION
    local tree=$work/unpacked
    rm -rf "$tree"
    mkdir -p "$tree"/{bin,share/{applications,mime/packages,bash-completion/completions,icons/hicolor/{16x16,scalable}/apps}}
    printf '#!/bin/sh\necho "runs from $0"\n' >"$tree/bin/pellucid"
    cp "$tree/bin/pellucid" "$tree/bin/pellucid-cli"
    chmod 755 "$tree"/bin/*
    cp "$linux/org.pellucid.Pellucid.desktop" "$tree/share/applications/"
    cp "$linux/pellucid-mime.xml" "$tree/share/mime/packages/pellucid.xml"
    cp "$linux/pellucid-cli.bash-completion" "$tree/share/bash-completion/completions/pellucid-cli"
    touch "$tree/share/icons/hicolor/16x16/apps/pellucid.png" "$tree/share/icons/hicolor/scalable/apps/pellucid.svg" "$tree/$1"
    cp "$linux/install.sh" "$linux/uninstall.sh" "$tree"
}
# An ordinary user's, whoever runs this: the superuser's own folders are not for tests.
mkdir "$work/tools"
printf '#!/bin/sh\necho 1000\n' >"$work/tools/id"
chmod 755 "$work/tools/id"
as_user() { env -i HOME="$home" PATH="$work/tools:$PATH" USER_PWD="$work" "$@"; }
install() { (umask 077 && cd "$work/unpacked" && as_user sh ./install.sh "$@" >"$work/said" 2>&1); }
all_of() { (cd "$1" && find . | sort); }
refuses() { # WHY ARGUMENTS...
    local why=$1 before
    shift
    before=$(all_of "$home")
    install "$@" && fail "installed, in spite of: $why"
    grep -q "$why" "$work/said" || fail "wanted: $why; said: $(cat "$work/said")"
    [[ $(all_of "$home") == "$before" ]] || fail "changed, after: $why"
}

unpacked first
n=0
for name in plain "two words" "o'brien & söhne|x"; do
    home=$work/$name
    mkdir -p "$home/.config"
    before=$(all_of "$home")
    install || fail "$name: $(cat "$work/said")"
    prefix=$home/.local/opt/pellucid
    [[ $(as_user "$home/.local/bin/pellucid") == "runs from $home/.local/bin/pellucid" ]] || fail "$name: does not run"
    [[ $(stat -c %a "$prefix/bin/pellucid") == 755 && $(stat -c %a "$home/.local/bin") == 755 ]] || fail "$name: not for others to read"
    entry=$home/.local/share/applications/org.pellucid.Pellucid.desktop
    grep -qxF "Exec=\"$prefix/bin/pellucid\" %F" "$entry" || fail "$name: $(grep Exec "$entry")"
    # What is somebody's: in the folder, beside it, and a program that took a name since.
    touch "$prefix/mine" "$home/.local/bin/mine"
    mkdir -p "$home/.local/share/pellucid/presets"
    # Over itself: what only the former one had goes.
    unpacked "second $((++n))"
    install || fail "$name, again: $(cat "$work/said")"
    [[ -e "$prefix/second $n" && ! -e $prefix/first ]] || fail "$name: not renewed"
    [[ -e $prefix.old/mine ]] || fail "$name: what was put into the folder is lost"
    rm -r "$prefix.old" "$home/.local/bin/mine"
    ln -sf /bin/true "$home/.local/bin/pellucid-cli"
    as_user sh "$home/.local/bin/pellucid-uninstall" >/dev/null
    [[ -e $home/.local/bin/pellucid-cli ]] || fail "$name: removed what is another's"
    rm -r "$home/.local/bin" "$home/.local/share/pellucid"
    rmdir -p --ignore-fail-on-non-empty "$home/.local/share" 2>/dev/null || true
    [[ $(all_of "$home") == "$before" ]] || fail "$name: left behind: $(all_of "$home")"
    unpacked first
done

home=$work/refused
mkdir -p "$home"/{tools,full}
touch "$home"/tools/{uninstall.sh,data}
chmod 755 "$home/tools/uninstall.sh"
refuses "is not Pellucid" --prefix "$home/tools"
refuses "cannot hold" --prefix "$home/100%"
refuses "unknown" --here
refuses "wants a folder" --prefix
mkdir -p "$home/.local/bin"
echo mine >"$home/.local/bin/pellucid"
refuses "is not Pellucid's"
rm -r "$home/.local"
# What fails on the way is taken back: a file where a folder has to be.
mkdir -p "$home/.local/share"
touch "$home/.local/share/icons"
refuses "was not installed"
rm -r "$home/.local"
# One at a time, and a folder as it was typed.
install --prefix "refused/here" || fail "$(cat "$work/said")"
[[ -x $home/here/bin/pellucid ]] || fail "not where it was asked for"
refuses "is installed in $home/here"
# An upgrade that fails leaves what was there.
unpacked second
rm -r "$home/.local/share/bash-completion"
touch "$home/.local/share/bash-completion"
install --prefix "refused/here" && fail "installed over a file"
[[ -e $home/here/first && ! -e $home/here.old && ! -e $home/here.new ]] || fail "the former one is lost"
as_user sh "$home/here/uninstall.sh" --quiet
rm "$home/.local/share/bash-completion" 2>/dev/null || true
[[ ! -e $home/here ]] || fail "still there"
