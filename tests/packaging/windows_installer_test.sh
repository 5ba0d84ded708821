#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs, uses, upgrades and removes Pellucid under Wine, in a Windows of its own: windows_installer_test.sh PACKAGES OUT.
# Screenshots in OUT are for looking at. Needs a display. PELLUCID_STUDY: a study to drop, a phantom if not set. PELLUCID_SLOW:
# seconds until a picture is surely shown, 20 if not set.
set -euo pipefail
packages=$(realpath "$1") out=$(mkdir -p "$2" && realpath "$2")
source_folder=$(realpath "$(dirname "$0")/../..")
installer=$(ls "$packages"/pellucid-*-windows-x86_64.exe) zip=$(ls "$packages"/pellucid-*-windows-x86_64.zip)
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
unset WINEPATH XDG_DATA_HOME XDG_CACHE_HOME XDG_CONFIG_HOME
mkdir "$home/windows"
# shellcheck source=../../packaging/windows/wine.sh
source "$source_folder/packaging/windows/wine.sh" "$home/windows"
trap 'wineserver -k || true; rm -rf "$home"' EXIT
unset WINEPATH # nothing but what is installed
drive=$WINEPREFIX/drive_c
local=$drive/users/$(id -un)/AppData/Local programs=$local/Programs/Pellucid
fail() { echo "windows_installer_test: $*" >&2; exit 1; }
check() { echo "== $*"; }
key='HKCU\Software\Microsoft\Windows\CurrentVersion\Uninstall\Pellucid'
shot() { ffmpeg -loglevel error -y -f x11grab -i "$DISPLAY" -frames:v 1 "$out/$1.png"; }

check "installing for this user"
wine "$installer" /S || fail "exit code $?"
[[ -f $programs/bin/pellucid.exe && ! -e $programs.new ]] || fail "nothing is installed"
wine reg query "$key" /v DisplayVersion | grep -q "0\.[0-9]" || fail "no entry among the apps"

check "the command line"
cli() { wine "$programs/bin/pellucid-cli.exe" "$@"; }
[[ $(cli --version) == "pellucid-cli "* ]] || fail "no version"
(cd "$home" && cli phantom study --size 32x32x32 && cli render study -o out.png && [[ -s out.png ]]) || fail "nothing is rendered"

# Screenshots also show whether the projection changed.
pixels() { ffmpeg -loglevel error -f x11grab -draw_mouse 0 -i "$DISPLAY" -frames:v 1 -vf "crop=$1" -f rawvideo - | sha256sum; }
changes() { # SECONDS WHAT COMMAND...: the projection within that time
    local seconds=$1 what=$2 before=
    shift 2
    until [[ $(pixels "$projection") == "$before" ]]; do # it may still be refined
        before=$(pixels "$projection")
        sleep 1
    done
    "$@"
    for ((i = 0; i < seconds; ++i)); do
        sleep 1
        [[ $(pixels "$projection") == "$before" ]] || return 0
    done
    fail "$what: the projection is the same"
}
window() { # TITLE: its number, as soon as it is there
    for _ in {1..120}; do
        xdotool search --onlyvisible --name "$1" 2>/dev/null | head -1 | grep . && return
        sleep 0.5
    done
    fail "no window: $1"
}
drag() { # WINDOW X Y, in it, and where to on the screen: X Y
    local X Y
    xdotool mousemove --window "$1" "$2" "$3" sleep 0.3 mousedown 1 sleep 0.3
    eval "$(xdotool getmouselocation --shell)"
    for i in {1..8}; do xdotool mousemove $((X + ($4 - X) * i / 8)) $((Y + ($5 - Y) * i / 8)) sleep 0.2; done
    xdotool mouseup 1
}
openbox &
check "the window"
file=$(find "$home/study" -name '*.dcm' | head -1)
wine "$programs/bin/pellucid.exe" "$home/study" &
id=$(window '^Pellucid$')
sleep "${PELLUCID_SLOW:-20}"
eval "$(xdotool getwindowgeometry --shell "$id")" # X, Y, WIDTH, HEIGHT
projection=$((WIDTH * 2 / 5)):$((HEIGHT / 2)):$((X + WIDTH * 7 / 20)):$((Y + HEIGHT / 4))
shot window

check "turning, a preset, and a picture of it"
middle=($((X + WIDTH / 2)) $((Y + HEIGHT / 2)))
changes 5 "turning" drag "$id" $((WIDTH / 2)) $((HEIGHT / 2)) $((middle[0] + 120)) "${middle[1]}"
shot turned
changes 10 "a preset" xdotool mousemove $((X + WIDTH * 87 / 100)) $((Y + HEIGHT * 12 / 100)) click 1
shot preset
xdotool key ctrl+e
window 'Export picture' >/dev/null
sleep 1
shot export
xdotool key Return
sleep 5
picture=$(find "$drive/users" -name projection.png)
[[ -s $picture ]] || fail "no picture"
cp "$picture" "$out/projection.png"

check "a folder dropped from the file manager opens"
mkdir "$drive/drop"
if [[ -n ${PELLUCID_STUDY:-} ]]; then
    cp -r "$PELLUCID_STUDY" "$drive/drop/a study"
else
    (cd "$drive/drop" && cli phantom "a study" --kind chest --size 32x32x32)
fi
wine explorer 'C:\drop' &
id=$(window '^drop$')
xdotool windowmove "$id" 0 0 windowactivate "$id" sleep 2
shot file_manager
changes 20 "dropping" drag "$id" 185 85 "${middle[@]}"
sleep 3
shot dropped

check "closing"
id=$(window '^Pellucid$')
xdotool windowactivate "$id" key alt+F4
for _ in {1..50}; do
    wine tasklist | grep -q '^pellucid\.exe' || break
    sleep 0.2
done
! wine tasklist | grep -q '^pellucid\.exe' || fail "it still runs"

check "an upgrade is refused while the program runs"
wine "$programs/bin/pellucid.exe" &
window '^Pellucid$' >/dev/null
code=0
wine "$installer" /S || code=$?
((code == 2)) || fail "exit code $code"
wineserver -k
sleep 1

check "an upgrade keeps what is the user's"
mkdir -p "$local/Pellucid/Data/presets"
echo '{}' >"$local/Pellucid/Data/presets/mine.json"
echo mine >"$programs/mine.txt"
wine "$installer" /S || fail "exit code $?"
[[ -f $local/Pellucid/Data/presets/mine.json && -f $programs.old/mine.txt && $(ls "$programs.old") == mine.txt ]] || fail "something is lost"

check "no folder of others is taken"
for name in file uninstall.exe; do
    mkdir -p "$drive/Other"
    echo other >"$drive/Other/$name"
    code=0
    wine "$installer" /S '/D=C:\Other' || code=$?
    ((code == 2)) && [[ $(ls "$drive/Other") == "$name" ]] || fail "it is: $name"
    rm "$drive/Other/$name"
done
mkdir -p "$drive/Place.new"
echo other >"$drive/Place.new/file"
code=0
wine "$installer" /S '/D=C:\Place' || code=$?
((code == 2)) && [[ -f $drive/Place.new/file ]] || fail "a folder beside it is"
rm -r "$drive/Place.new"
code=0
wine "$installer" /S "/D=C:\\users\\$(id -un)\\AppData\\Local\\Pellucid\\Here" || code=$?
((code == 2)) && [[ ! -e $local/Pellucid/Here ]] || fail "the folder of the data is"

check "what an interrupted installation has left is replaced"
cp -r "$programs" "$programs.new"
wine "$installer" /S || fail "exit code $?"
[[ -f $programs/bin/pellucid.exe && ! -e $programs.new ]] || fail "it is in the way"

check "another folder takes the place of the former one"
wine "$programs/bin/pellucid.exe" &
window '^Pellucid$' >/dev/null
code=0
wine "$installer" /S '/D=C:\Place' || code=$?
((code == 2)) && [[ ! -e $drive/Place && -f $programs/bin/pellucid.exe ]] || fail "it moves while the program runs"
wineserver -k
sleep 1
wine "$installer" /S '/D=C:\Place' || fail "exit code $?"
[[ -f $drive/Place/bin/pellucid.exe && ! -e $programs ]] || fail "both are there"
wine "$installer" /S "/D=C:\\users\\$(id -un)\\AppData\\Local\\Programs\\Pellucid" || fail "exit code $?"
[[ -f $programs/bin/pellucid.exe && ! -e $drive/Place ]] || fail "both are there"

# An uninstaller goes on as a copy of itself.
gone() { # FOLDER START_MENU ROOT
    for _ in {1..50}; do
        [[ -e $1 ]] || break
        sleep 0.2
    done
    [[ ! -e $1 ]] || fail "left: $(ls -R "$1")"
    [[ ! -e $2/Pellucid.lnk ]] || fail "left in the Start menu"
    # Settings stay with the data: Software\pellucid.
    if wine reg query "$3\\Software\\Classes" /s | grep -i pellucid || wine reg query "$3\\Software\\RegisteredApplications" | grep -i pellucid ||
        wine reg query "$3\\Software\\Microsoft\\Windows\\CurrentVersion\\Uninstall" | grep -i pellucid ||
        wine reg query "$3\\Software\\Pellucid\\Capabilities"; then
        fail "left in the registry"
    fi
}
start_menu='Microsoft/Windows/Start Menu/Programs'
check "removing keeps the user's data"
wine "$programs/uninstall.exe" /S || fail "exit code $?"
gone "$programs" "$drive/users/$(id -un)/AppData/Roaming/$start_menu" HKCU
[[ -f $local/Pellucid/Data/presets/mine.json ]] || fail "the user's data are gone"

check "removing with the data, without the images"
wine "$installer" /S || fail "exit code $?"
mkdir -p "$local/Pellucid/Data/library/files"
echo image >"$local/Pellucid/Data/library/files/image.dcm"
wine "$programs/uninstall.exe" &
id=$(window 'Pellucid.*Uninstall')
xdotool windowactivate "$id" sleep 1 key Return sleep 1 # Uninstall
for answer in alt+y alt+n; do
    sleep 3
    shot "removing_$answer"
    xdotool key "$answer"
done
gone "$programs" "$drive/users/$(id -un)/AppData/Roaming/$start_menu" HKCU
for _ in {1..50}; do
    [[ -e $local/Pellucid/Data/presets ]] || break
    sleep 0.2
done
[[ $(cd "$local" && find Pellucid* -type f) == Pellucid/Data/library/files/image.dcm ]] || fail "kept: $(find "$local"/Pellucid*)"
wineserver -k
sleep 1

check "installing for all users"
wine "$installer" /S /AllUsers || fail "exit code $?"
[[ -f "$drive/Program Files/Pellucid/bin/pellucid.exe" ]] || fail "nothing is installed"

check "a double-click on a file opens it" # Wine does not look at the file types of one user
wine start /unix "$file" &
window '^Pellucid$' >/dev/null
sleep "${PELLUCID_SLOW:-20}"
shot double_click
wineserver -k
sleep 1
wine "$drive/Program Files/Pellucid/uninstall.exe" /S || fail "exit code $?"
gone "$drive/Program Files/Pellucid" "$drive/ProgramData/$start_menu" HKLM

check "the ZIP"
(cd "$home" && unzip -q "$zip" && cd pellucid-*/bin && wine pellucid-cli.exe --version) || fail "it does not run"
echo "windows_installer_test: passed"
