#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the packages in bare systems: the .deb in a Debian without build tools, the self-extracting installer in the next
# Debian as an ordinary user, the bundle of pellucid-cli in both. Runs as root, takes some minutes and 3 GB below WORK, and leaves screenshots and a report
# in PACKAGES/../install-test.
#   install_test.sh PACKAGES [WORK]
set -euo pipefail
packages=$(realpath "$1") work=${2:-/var/tmp/pellucid-install-test}
out=$packages/../install-test
deb=$(ls "$packages"/pellucid_*.deb) run=$(ls "$packages"/pellucid-[0-9]*.run) cli=$(ls "$packages"/pellucid-cli-*.run)
((EUID == 0)) || { echo "install_test: needs root for its chroots" >&2; exit 1; }
mkdir -p "$work" "$out"
out=$(realpath "$out")
report=$out/report.txt
: >"$report"

expected=$(basename "$run") expected=${expected#pellucid-} expected=${expected%-linux-*}

say() { echo "$*" | tee -a "$report"; }
fail() { say "FAILED: $*"; exit 1; }

mounted=()
finish() {
    local n
    for ((n = ${#mounted[@]} - 1; n >= 0; --n)); do umount -l "${mounted[n]}" || true; done
}
trap finish EXIT

# The mirror that this machine uses.
mirror() { apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Origin: Debian' | head -1; }

# Creates a bare system with an ordinary user, from a base that is built once and copied.
system() { # RELEASE NAME
    local base=$work/$1-base
    root=$work/$2
    if [[ ! -d $base ]]; then
        rm -rf --one-file-system "$base.new" # left by an interrupted run
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
    # Its own devices, so that nothing of this machine can be damaged.
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

spread() { convert "$1" -gravity center -crop 60%x80%+0+0 -colorspace gray -format '%[fx:standard_deviation]' info:; }
# Uses every program, and takes pictures of the window: with nothing open, with a study, and started from the menu entry.
use_it() { # NAME ENTRY
    [[ $(as_user pellucid --version) == "pellucid $expected" ]] || fail "$1: $(as_user pellucid --version) is not $expected"
    as_user desktop-file-validate "$2" || fail "$1: the menu entry"
    as_user pellucid-cli phantom /home/tester/head --kind head --size 128x128x96 >/dev/null || fail "$1: phantom"
    as_user pellucid-cli render /home/tester/head -o /home/tester/front.png --json >"$out/$1-render.json" || fail "$1: render"
    cp "$root/home/tester/front.png" "$out/$1-front.png"
    awk -v s="$(spread "$out/$1-front.png")" 'BEGIN { exit !(s > 0.15) }' || fail "$1: the projection shows nothing"
    local first
    first=$(cd "$root/home/tester" && find head -type f | sort | head -1)
    [[ $(as_user gio mime application/dicom) == *"Default application"*org.pellucid.Pellucid.desktop* ]] || fail "$1: Pellucid is not the default program for DICOM files"
    [[ $(as_user gio info -a standard::content-type "/home/tester/$first") == *application/dicom* ]] || fail "$1: DICOM files are not recognised"
    # Starts a screen and the program, waits, and takes a picture of the screen.
    cat >"$root/home/tester/look.sh" <<'TEXT'
started() { # its window is visible on the screen
    xwininfo -root -tree 2>/dev/null | grep -oE '0x[0-9a-f]+ "[^"]*Pellucid.* [0-9]{4}x[0-9]{3,4}\+' | cut -d' ' -f1 |
        xargs -r -n1 xwininfo -id 2>/dev/null | grep -q IsViewable
}
for run in cold warm menu; do
    begin=$(date +%s%N)
    case $run in
        cold) pellucid 2>stderr & ;;
        warm) pellucid head 2>stderr & ;;
        menu) gio launch "$1" "$2" 2>stderr & ;;
    esac
    program=$!
    tries=0
    until started; do
        sleep 0.02
        tries=$((tries + 1))
        [ $tries -lt 1500 ] || exit 1
        [ $run = menu ] || kill -0 $program || exit 1
    done
    echo "$run $((($(date +%s%N) - begin) / 1000000)) ms" >>milliseconds
    sleep 12
    import -window root $run.png
    [ $run != menu ] || program=$(pgrep -x pellucid)
    kill $program
    [ $run = menu ] || wait $program || exit 1 # it must end normally
done
while pgrep -x pellucid >/dev/null; do sleep 0.1; done
TEXT
    rm -f "$root/home/tester/milliseconds"
    as_user sh -c 'cd; xvfb-run -a -s "-screen 0 1600x1000x24" sh ./look.sh "$0" head' "$2" || {
        cat "$root/home/tester/stderr"
        fail "$1: the workstation"
    }
    say "$1: window after $(paste -sd, "$root/home/tester/milliseconds")"
    awk '$1 == "warm" { exit !($2 <= 1500) }' "$root/home/tester/milliseconds" || fail "$1: the window takes more than 1.5 s"
    local run
    for run in cold warm menu; do cp "$root/home/tester/$run.png" "$out/$1-$run.png"; done
    # A picture of a head has more contrast than the start page.
    for run in warm menu; do
        awk -v s="$(spread "$out/$1-$run.png")" -v empty="$(spread "$out/$1-cold.png")" 'BEGIN { exit !(s > 2.5 * empty && s > 0.15) }' ||
            fail "$1: the window shows nothing ($run)"
        say "$1, $run: the window shows a study (spread $(spread "$out/$1-$run.png"), without one $(spread "$out/$1-cold.png"))"
    done
}
# Saves a preset, and adds a study to the library's list, which the program creates at its start.
keep_something() {
    as_user sh -c 'cd; xvfb-run -a sh -c "pellucid & sleep 6; kill \$!; wait"' || fail "the workstation"
    as_user sqlite3 /home/tester/.local/share/pellucid/library/library.sqlite "insert into studies (patient_id, patient_name, birth_date,
        sex, uid, date, description, modalities, sort_name, search, added) values ('1', 'Kept^Study', '', '', '1.2.3', '', '', 'CT', 'kept', 'kept', 1)" ||
        fail "there is no library"
    as_user sh -c 'cd /home/tester && pellucid-cli preset show "Bone" | sed "s/\"Bone\"/\"Kept by the tester\"/" >mine.json &&
        pellucid-cli preset import mine.json' >/dev/null || fail "the preset is not saved"
}
still_kept() { # WHEN
    as_user grep -rqF "Kept by the tester" /home/tester/.local/share/pellucid || fail "$1: the preset is lost"
    [[ $(as_user sqlite3 /home/tester/.local/share/pellucid/library/library.sqlite 'select patient_name from studies') == Kept^Study ]] ||
        fail "$1: the library is lost"
}
# Every file except those that a system writes by itself.
all_of_it() {
    (cd "$root" && find . -xdev \( -path ./proc -o -path ./sys -o -path ./dev -o -path ./tmp -o -path ./run -o -path ./var/log -o -path ./var/cache \
        -o -path './home/tester/.cache/mesa_shader_cache*' -o -path './home/tester/.cache/qtshadercache*' -o -path ./home/tester/.cache/fontconfig \) -prune -o -print | sort)
}
nothing_is_left() { # WHAT BEFORE AFTER
    local left
    left=$(comm -13 "$2" "$3")
    [[ -z $left ]] || fail "$1: left behind: $left"
}
# What a desktop provides, and what inspects it.
tools=(xvfb xauth x11-utils imagemagick fonts-dejavu-core procps sqlite3 desktop-file-utils shared-mime-info libglib2.0-bin)

say "$(sha256sum "$deb" "$run" "$cli" | sed 's#/.*/##')"
say "== $(basename "$deb") in a bare Debian"
system bookworm deb
apt_install "${tools[@]}"
old=$work/older
rm -rf "$old" && dpkg-deb -R "$deb" "$old"
sed -i 's/^Version: .*/Version: 0.0.9/' "$old/DEBIAN/control"
mkdir "$old/usr/share/pellucid-was"
touch "$old/usr/share/pellucid-was/file"
dpkg-deb --root-owner-group -b "$old" "$root/tmp/older.deb" >/dev/null
cp "$deb" "$root/tmp/new.deb"
apt_install /tmp/older.deb
keep_something
apt_install /tmp/new.deb
version=$(as_root dpkg-query -W -f='${Version}' pellucid)
[[ $version == "$expected" ]] || fail "not upgraded: $version"
[[ ! -e $root/usr/share/pellucid-was ]] || fail "a file of the former version is still there"
say "upgraded from 0.0.9 to $version"
as_root sh -c '! command -v gcc && ! command -v cmake' >/dev/null || fail "there are build tools"
use_it deb /usr/share/applications/org.pellucid.Pellucid.desktop
still_kept "upgrade"
as_root apt-get purge -y -qq pellucid >/dev/null 2>&1 || fail "purge"
# Its dependencies stay, as with every package.
left=$(all_of_it | grep -i pellucid | grep -v -e '^./home/tester/' -e '^./var/lib/apt/' || true)
[[ -z $left ]] || fail "left behind: $left"
still_kept "removal"
say "removed; the user's own files remain: $(cd "$root/home/tester" && find .local .cache .config -maxdepth 2 -name 'pellucid*' 2>/dev/null | tr '\n' ' ')"

say "== $(basename "$run") on the next Debian, as an ordinary user"
system trixie run
apt_install "${tools[@]}" libgl1 libegl1 libgl1-mesa-dri libfontconfig1 libx11-xcb1 libglib2.0-0t64
cp "$run" "$root/home/tester/pellucid.run"
all_of_it >"$work/before"
as_user sh /home/tester/pellucid.run --quiet | tee -a "$report"
keep_something
# A file that only the former version had.
as_user sh -c 'cd ~/.local/opt/pellucid && mkdir was && touch was/file && echo "inside /was/file" >>share/pellucid/installation'
as_user sh /home/tester/pellucid.run --quiet >/dev/null # reinstalls
[[ ! -e $root/home/tester/.local/opt/pellucid/was && ! -e $root/home/tester/.local/opt/pellucid.old ]] || fail "something of the former version is still there"
use_it run /home/tester/.local/share/applications/org.pellucid.Pellucid.desktop
still_kept "upgrade"
as_user pellucid-uninstall >/dev/null
all_of_it | grep -v -e '^./home/tester/.local$' -e '^./home/tester/.local/share$' -e '^./home/tester/.local/share/pellucid' -e '^./home/tester/.config' \
    -e '^./home/tester/\(head\|front.png\|look.sh\|milliseconds\|stderr\|mine.json\|cold.png\|warm.png\|menu.png\)' -e '^./home/tester/.cache$' \
    -e '^./home/tester/.local/share/gvfs-metadata' >"$work/after"
nothing_is_left "an ordinary user" "$work/before" "$work/after"
still_kept "removal"
say "removed; the user's presets, studies and settings are kept"

say "== the same as root, for all users"
all_of_it >"$work/before"
as_root sh /home/tester/pellucid.run --quiet >/dev/null
[[ $(as_user /usr/local/bin/pellucid --version) == "pellucid $expected" ]] || fail "an ordinary user cannot start it"
as_user /usr/local/bin/pellucid-cli render /home/tester/head -o /home/tester/front.png >/dev/null || fail "an ordinary user cannot use it"
if as_user /usr/local/bin/pellucid-uninstall 2>/dev/null; then fail "an ordinary user can remove it"; fi
[[ $(as_user gio mime application/dicom) == *org.pellucid.Pellucid.desktop* ]] || fail "it is not in the users' menu"
as_root /usr/local/bin/pellucid-uninstall >/dev/null
as_user rm -rf /home/tester/.cache/pellucid # root's uninstaller leaves users' folders alone
all_of_it >"$work/after"
nothing_is_left "root" "$work/before" "$work/after"
say "removed; nothing is left"
# No package is installed here, as on the nodes of a cluster.
for release in bookworm trixie; do
    say "== $(basename "$cli") in a bare $release, as an ordinary user"
    system $release "cli-$release"
    cp "$cli" "$root/home/tester/cli.run"
    as_user sh -c 'cd && sh cli.run --quiet programs' | tee -a "$report"
    [[ $(as_user /home/tester/programs/pellucid-cli --version) == "pellucid-cli $expected" ]] || fail "$release: not $expected"
    echo '{"recipe": 1, "outputs": [{"view": "front", "size": 128}, {"name": "turn", "format": "dicom", "turntable": 4, "size": 64}]}' \
        >"$root/home/tester/recipe.json"
    as_user sh -c 'cd && PATH=~/programs:$PATH && pellucid-cli phantom head --kind head --size 64x64x48 && pellucid-cli recipe check recipe.json &&
        pellucid-cli batch recipe.json head --out results' >"$work/batch.log" 2>&1 || fail "$release: $(cat "$work/batch.log")"
    made=$(cd "$root"/home/tester/results/* && echo *)
    [[ $made == "done.json front.png turn"* ]] || fail "$release: there is only $made"
    say "rendered in $release: $made"
done
say "all passed; the bare systems are kept in $work for the next run"
