#!/usr/bin/env bash
# Installs the packages where nothing was installed: a bare Debian without build tools for the .deb,
# the next Debian for the self-extracting installer, by an ordinary user. Runs as root, takes some
# minutes and 3 GB below WORK, and leaves screenshots and a report in PACKAGES/../install-test.
#   install_test.sh PACKAGES [WORK]
set -euo pipefail
packages=$(realpath "$1") work=${2:-/var/tmp/pellucid-install-test}
out=$packages/../install-test
deb=$(ls "$packages"/pellucid_*.deb) run=$(ls "$packages"/pellucid-*.run)
((EUID == 0)) || { echo "install_test: needs root for its chroots" >&2; exit 1; }
mkdir -p "$work" "$out"
out=$(realpath "$out")
report=$out/report.txt
: >"$report"

say() { echo "$*" | tee -a "$report"; }
fail() { say "FAILED: $*"; exit 1; }

mounted=()
finish() {
    local n
    for ((n = ${#mounted[@]} - 1; n >= 0; --n)); do umount -l "${mounted[n]}" || true; done
}
trap finish EXIT

# The packages come from where this machine's own come from.
mirror() { apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Origin: Debian' | head -1; }

# A system of its own with an ordinary user, made once and copied.
system() { # RELEASE NAME
    local base=$work/$1-base
    root=$work/$2
    if [[ ! -d $base ]]; then
        debootstrap --variant=minbase --include=ca-certificates "$1" "$base.new" "$(mirror)" >"$work/debootstrap.log" 2>&1 ||
            { tail -5 "$work/debootstrap.log"; fail "no bare system"; }
        for file in /etc/apt/apt.conf.d /etc/apt/apt.conf /etc/resolv.conf /etc/hosts /usr/local/share/ca-certificates /etc/ssl/certs; do
            [[ -e $file ]] && mkdir -p "$base.new$(dirname "$file")" && cp -aLn "$file" "$base.new$(dirname "$file")/" 2>/dev/null || true
        done
        mv "$base.new" "$base"
    fi
    umount "$root"/{proc,dev} 2>/dev/null || true
    rm -rf --one-file-system "$root"
    cp -a "$base" "$root"
    # Devices of its own: nothing of this machine can be lost in here.
    mount -t proc proc "$root/proc" || fail "nothing can be mounted here"
    mounted+=("$root/proc")
    mount -t tmpfs -o mode=755 devices "$root/dev" || fail "nothing can be mounted here"
    mounted+=("$root/dev")
    local device
    for device in null:3 zero:5 full:7 random:8 urandom:9; do
        mknod -m 666 "$root/dev/${device%:*}" c 1 "${device#*:}"
    done
    mkdir -m 1777 "$root/dev/shm"
    ln -s /proc/self/fd "$root/dev/fd"
    chroot "$root" useradd -m tester
    chroot "$root" apt-get update -qq
}
as_root() { chroot "$root" env DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }
as_user() { chroot --userspec=tester:tester "$root" env -i HOME=/home/tester PATH=/home/tester/.local/bin:/usr/bin:/bin \
    LANG=C.UTF-8 LIBGL_ALWAYS_SOFTWARE=1 "$@"; }
apt_install() { as_root apt-get install -y -qq --no-install-recommends "$@" >"$work/apt.log" 2>&1 || { tail -20 "$work/apt.log"; fail "apt: $*"; }; }

# Every program, and the window with a study in it, as a picture.
use_it() { # NAME
    as_user pellucid --version | tee -a "$report"
    as_user pellucid-cli phantom /home/tester/head --kind head --size 128x128x96 >/dev/null || fail "$1: phantom"
    as_user pellucid-cli render /home/tester/head -o /home/tester/front.png --json >"$out/$1-render.json" || fail "$1: render"
    cp "$root/home/tester/front.png" "$out/$1-front.png"
    # A screen, the program, a moment, a picture of all of it.
    cat >"$root/home/tester/look.sh" <<'TEXT'
started() { # its window, on the screen; not one of those that nobody sees
    xwininfo -root -tree 2>/dev/null | grep -oE '0x[0-9a-f]+ "[^"]*Pellucid.* [0-9]{4}x[0-9]{3,4}\+' | cut -d' ' -f1 |
        xargs -r -n1 xwininfo -id 2>/dev/null | grep -q IsViewable
}
for run in cold warm; do
    begin=$(date +%s%N)
    pellucid head 2>stderr &
    program=$!
    tries=0
    until started; do
        sleep 0.02
        tries=$((tries + 1))
        [ $tries -lt 1500 ] && kill -0 $program || exit 1
    done
    echo "$run $((($(date +%s%N) - begin) / 1000000)) ms" >>milliseconds
    sleep 12
    import -window root window.png
    kill $program
    wait $program || exit 1 # it ends as one that is closed
done
TEXT
    as_user sh -c 'cd; xvfb-run -a -s "-screen 0 1600x1000x24" sh ./look.sh' || {
        cat "$root/home/tester/stderr"
        fail "$1: the workstation"
    }
    cp "$root/home/tester/window.png" "$out/$1-window.png"
    say "$1: window after $(paste -sd, "$root/home/tester/milliseconds")"
    # A picture of a head is neither empty nor of one grey, in the window's right half.
    local spread
    spread=$(convert "$out/$1-window.png" -gravity center -crop 60%x80%+0+0 -colorspace gray -format '%[fx:standard_deviation]' info:)
    awk -v s="$spread" 'BEGIN { exit !(s > 0.05) }' || fail "$1: the window shows nothing ($spread)"
    say "$1: the window shows a study (spread $spread)"
}
keep_something() {
    as_user sh -c 'cd /home/tester && pellucid-cli preset show "Bone" | sed "s/\"Bone\"/\"Kept by the tester\"/" >mine.json &&
        pellucid-cli preset import mine.json' >/dev/null || fail "no preset is kept"
}
still_kept() { as_user pellucid-cli preset list | grep -q "Kept by the tester" || fail "$1: the preset is lost"; }
what_is_left() {
    find "$root" -xdev \( -path "$root/proc" -o -path "$root/sys" -o -path "$root/dev" -o -path "$root/home/tester" -o -path "$root/tmp" \
        -o -path "$root/var/lib/apt" -o -path "$root/var/cache" -o -path "$root/var/log" \) -prune -o -iname '*pellucid*' -print
}

say "== $(basename "$deb") in a bare Debian"
system bookworm deb
apt_install xvfb xauth x11-utils imagemagick fonts-dejavu-core
old=$work/older
rm -rf "$old" && dpkg-deb -R "$deb" "$old"
sed -i 's/^Version: .*/Version: 0.0.9/' "$old/DEBIAN/control"
dpkg-deb --root-owner-group -b "$old" "$root/tmp/older.deb" >/dev/null
cp "$deb" "$root/tmp/new.deb"
apt_install /tmp/older.deb
keep_something
apt_install /tmp/new.deb
version=$(as_root dpkg-query -W -f='${Version}' pellucid)
[[ $version != 0.0.9 ]] || fail "not upgraded"
say "upgraded from 0.0.9 to $version"
still_kept "upgrade"
as_root sh -c '! command -v gcc && ! command -v cmake' >/dev/null || fail "there are build tools"
use_it deb
as_root apt-get purge -y -qq pellucid >/dev/null 2>&1 || fail "purge"
left=$(what_is_left)
[[ -z $left ]] || fail "left behind: $left"
[[ -n $(find "$root/home/tester/.local/share/pellucid" -name '*.json') ]] || fail "the user's presets are gone"
say "removed; of it remain the user's own: $(cd "$root/home/tester" && find .local .cache .config -maxdepth 2 -name 'pellucid*' 2>/dev/null | tr '\n' ' ')"

say "== $(basename "$run") on the next Debian, by an ordinary user"
system trixie run
# What a desktop has: a display server, OpenGL, fonts.
apt_install xvfb xauth x11-utils imagemagick fonts-dejavu-core libgl1 libegl1 libgl1-mesa-dri libfontconfig1 libx11-xcb1 libglib2.0-0t64
cp "$run" "$root/home/tester/pellucid.run"
as_user sh /home/tester/pellucid.run --quiet | tee -a "$report"
keep_something
use_it run
as_user sh /home/tester/pellucid.run --quiet >/dev/null # over itself
still_kept "upgrade"
as_user pellucid-uninstall >/dev/null
left=$(what_is_left; find "$root/home/tester" -iname '*pellucid*' -not -path '*/.local/share/pellucid*' -not -path '*/.cache/*' -not -path '*/.config/*' -not -name pellucid.run)
[[ -z $left ]] || fail "left behind: $left"
[[ -n $(find "$root/home/tester/.local/share/pellucid" -name '*.json') ]] || fail "the user's presets are gone"
say "removed; the user's presets are kept"
say "all passed"
