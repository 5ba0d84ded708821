#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a program in a session that has a keychain of its own: GNOME's, unlocked by an empty password,
# in a temporary folder. Exits with 77, which ctest counts as skipped, where no keychain can run.
set -euo pipefail

skip() {
    echo "with_keychain: skipped: $1" >&2
    exit 77
}

if [[ ${1:-} == --in-session ]]; then
    shift
    log=$HOME/keychain.log
    gnome-keyring-daemon --foreground --unlock --components=secrets <<<"" >"$log" 2>&1 &
    gdbus wait --session --timeout 30 org.freedesktop.secrets ||
        skip "the keychain does not start: $(tail -1 "$log")"
    PELLUCID_TEST_KEYCHAIN=1 exec "$@"
fi

for program in dbus-run-session gdbus gnome-keyring-daemon; do
    command -v "$program" >/dev/null || skip "$program is not installed"
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -m 700 "$folder"/{home,data,runtime}
export HOME=$folder/home XDG_DATA_HOME=$folder/data XDG_RUNTIME_DIR=$folder/runtime
# Without a display, a keychain that wants to ask for a password fails instead of waiting.
unset DISPLAY WAYLAND_DISPLAY
# The desktop decides which keychain the program uses.
unset XDG_CURRENT_DESKTOP DESKTOP_SESSION KDE_FULL_SESSION GNOME_KEYRING_CONTROL
dbus-run-session -- "$0" --in-session "$@"
