#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the installer's scripts with a program of a few lines in place of Pellucid: uninstalling removes everything that
# they made, to the last folder, and leaves other files alone. `./dev install-test` tries the whole packages in bare
# systems.
#   installer_test.sh SOURCE
set -euo pipefail
linux=$(realpath "$1")/packaging/linux
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "installer_test: $*" >&2; exit 1; }

# The tree as the archive unpacks it; VERSION is a file that only this version has.
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
# The tests act as an ordinary user, because they must not touch root's own folders.
mkdir "$work/tools"
printf '#!/bin/sh\necho 1000\n' >"$work/tools/id"
chmod 755 "$work/tools/id"
as_user() { env -i HOME="$home" PATH="$work/tools:$PATH" USER_PWD="$work" "$@"; }
install() { (umask 077 && cd "$work/unpacked" && as_user sh ./install.sh "$@" >"$work/output" 2>&1); }
# Lists names, the targets of links and the contents of files.
all_of() { (cd "$1" && find . -printf '%p %y %l\n' | sort && find . -type f -print0 | sort -z | xargs -0 -r cksum); }
refuses() { # WHY ARGUMENTS...
    local why=$1 before
    shift
    before=$(all_of "$home")
    install "$@" && fail "installed, in spite of: $why"
    grep -q "$why" "$work/output" || fail "expected: $why; got: $(cat "$work/output")"
    [[ $(all_of "$home") == "$before" ]] || fail "changed, after: $why"
}

unpacked first
n=0
for name in plain "two words" "o'brien & söhne|x"; do
    home=$work/$name
    mkdir -p "$home/.config"
    before=$(all_of "$home")
    install || fail "$name: $(cat "$work/output")"
    prefix=$home/.local/opt/pellucid
    [[ $(as_user "$home/.local/bin/pellucid") == "runs from $home/.local/bin/pellucid" ]] || fail "$name: does not run"
    [[ $(stat -c %a "$prefix/bin/pellucid") == 755 && $(stat -c %a "$home/.local/bin") == 755 ]] || fail "$name: not for others to read"
    entry=$home/.local/share/applications/org.pellucid.Pellucid.desktop
    grep -qxF "Exec=\"$prefix/bin/pellucid\" %U" "$entry" || fail "$name: $(grep Exec "$entry")"
    # Files of the user: in the folder, beside it, and a program that has taken a name since.
    touch "$prefix/mine" "$home/.local/bin/mine"
    mkdir -p "$home/.local/share/pellucid/presets" "$home/.cache/pellucid"
    touch "$home/.cache/pellucid/log"
    # An upgrade removes the files that only the former version had.
    unpacked "second $((++n))"
    install || fail "$name, again: $(cat "$work/output")"
    [[ -e "$prefix/second $n" && ! -e $prefix/first ]] || fail "$name: not renewed"
    [[ -e $prefix.old/mine ]] || fail "$name: what was put into the folder is lost"
    rm -r "$prefix.old" "$home/.local/bin/mine"
    rm "$home/.local/bin/pellucid-cli"
    echo mine >"$home/.local/bin/pellucid-cli"
    as_user sh "$home/.local/bin/pellucid-uninstall" >/dev/null
    [[ $(cat "$home/.local/bin/pellucid-cli") == mine ]] || fail "$name: removed what is another's"
    rm -r "$home/.local/bin" "$home/.local/share/pellucid"
    rmdir "$home/.cache"
    rmdir -p --ignore-fail-on-non-empty "$home/.local/share" 2>/dev/null || true
    [[ $(all_of "$home") == "$before" ]] || fail "$name: left behind: $(all_of "$home")"
    unpacked first
done

home=$work/refused
mkdir -p "$home"/{tools,x.new,src/bin}
touch "$home"/tools/{uninstall.sh,data} "$home/x.new/thesis" "$home/src/bin/pellucid"
chmod 755 "$home/tools/uninstall.sh"
refuses "is not Pellucid" --prefix "$home/tools"
refuses "is in the way" --prefix "$home/x"
refuses "cannot hold" --prefix "$home/100%"
refuses "cannot hold" --prefix "$home/a:b"
refuses "is no place" --prefix "$home/.local"
refuses "is no place" --prefix "$home/.local/share/pellucid"
refuses "is no place" --prefix "$home/.local/share/pellucid/programs"
refuses "unknown" --here
refuses "needs a folder" --prefix
mkdir -p "$home/.local/bin"
echo mine >"$home/.local/bin/pellucid"
refuses "is not Pellucid's"
ln -sf ../../src/bin/pellucid "$home/.local/bin/pellucid"
refuses "is not Pellucid's"
rm -r "$home/.local"
# A failed installation is undone: here a file is in place of a folder.
mkdir -p "$home/.local/share"
touch "$home/.local/share/icons"
refuses "was not installed"
rm -r "$home/.local"
# Only one installation is allowed, in the folder as it was typed.
install --prefix "refused/./here" || fail "$(cat "$work/output")"
[[ -x $home/here/bin/pellucid ]] || fail "not where it was asked for"
refuses "already installed in $home/here"
# An upgrade that fails leaves what was there.
unpacked second
touch "$work/unpacked/share/icons/hicolor/scalable/apps/new.svg"
rm "$home/.local/share/mime/packages/pellucid.xml"
mkdir "$home/.local/share/mime/packages/pellucid.xml"
refuses "was not installed" --prefix "$home/here"
rmdir "$home/.local/share/mime/packages/pellucid.xml"
# A successful upgrade removes what the former version had elsewhere, and repairs.
rm "$home/here/bin/pellucid" "$work/unpacked/share/icons/hicolor/scalable/apps/pellucid.svg"
mkdir "$home/data"
as_user XDG_DATA_HOME="$home/data" sh "$work/unpacked/install.sh" --prefix "$home/here" >/dev/null
[[ -x $home/here/bin/pellucid && ! -e $home/.local/share/applications/org.pellucid.Pellucid.desktop ]] || fail "the former menu entry stays"
as_user sh "$home/here/uninstall.sh" >/dev/null
left=$(cd "$home" && find . -iname '*pellucid*' -not -path './src/*' -print -o -path './.local/*' -print)
[[ -z $left ]] || fail "left behind: $left"

# A copy owns nothing elsewhere, and relative paths in the environment are ignored.
install || fail "$(cat "$work/output")"
cp -a "$home/.local/opt/pellucid" "$home/copy"
as_user sh "$home/copy/uninstall.sh" >/dev/null
[[ ! -e $home/copy && -x $home/.local/bin/pellucid && -e $home/.local/share/applications/org.pellucid.Pellucid.desktop ]] || fail "a copy took the installation along"
mkdir -p "$work/here/pellucid"
(cd "$work/here" && as_user XDG_CACHE_HOME=. sh "$home/.local/bin/pellucid-uninstall" >/dev/null)
[[ -d $work/here/pellucid ]] || fail "a folder of the place where it was started is gone"
[[ ! -e $home/.local/opt/pellucid ]] || fail "still there"

# Stopped at any time, or killed, it leaves the former or the new state, and the next installation is complete.
home=$work/stopped
mkdir -p "$home/.config"
before=$(all_of "$home")
unpacked first
whole() { [[ -x $home/.local/opt/pellucid/bin/pellucid && -e $home/.local/share/applications/org.pellucid.Pellucid.desktop && -L $home/.local/bin/pellucid-uninstall ]]; }
for signal in TERM KILL; do
    for round in fresh renewed; do
        for ms in 005 010 015 020 025 030 040 050 060 080 100; do
            if [[ $round == renewed ]]; then
                install || fail "after SIG$signal: $(cat "$work/output")"
                was=$(all_of "$home")
            else
                was=$before
            fi
            (umask 077 && cd "$work/unpacked" && exec env -i HOME="$home" PATH="$work/tools:$PATH" sh ./install.sh >"$work/output" 2>&1) &
            sleep "0.$ms"
            kill -s $signal $! 2>/dev/null || true
            wait $! 2>/dev/null || true
            if [[ $signal == TERM ]] && ! whole && [[ $(all_of "$home") != "$was" ]]; then
                fail "SIGTERM after $ms ms: neither as before nor whole: $(diff <(echo "$was") <(all_of "$home"))"
            fi
            sleep 0.02 # what a killed one started
            install || fail "after SIG$signal: $(cat "$work/output")"
            whole || fail "SIG$signal after $ms ms: not whole after the next"
            as_user sh "$home/.local/opt/pellucid/uninstall.sh" >/dev/null
            left=$(cd "$home" && find . -type f -o -type l)
            [[ -z $left ]] || fail "SIG$signal after $ms ms: left behind: $left"
            rm -rf "$home/.local" "$home/.cache" # folders that a killed one made
        done
    done
done
# Two installations at once take turns.
for round in 1 2 3; do
    for one in a b; do
        (cd "$work/unpacked" && as_user sh ./install.sh >"$work/output.$one" 2>&1) &
        sleep 0.0$round
    done
    wait
    whole || fail "two at once: $(cat "$work"/said.?)"
    as_user sh "$home/.local/bin/pellucid-uninstall" >/dev/null
    [[ $(all_of "$home") == "$before" ]] || fail "two at once: left behind: $(diff <(echo "$before") <(all_of "$home"))"
done
