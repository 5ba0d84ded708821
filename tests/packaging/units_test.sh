#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The commands of the services of systemd work as they stand there, with the folders that systemd would give them; and systemd
# understands every line of the units, if it is installed.
#   units_test.sh SOURCE PELLUCID_CLI
set -euo pipefail
source=$1 cli=$2
work=$(mktemp -d)
trap 'kill "${listening:-}" 2>/dev/null || true; rm -rf "$work"' EXIT
fail() { echo "units_test: $*" >&2; exit 1; }
export XDG_DATA_HOME=$work/etc XDG_CACHE_HOME=$work/cache
mkdir -p "$work"/etc/pellucid "$work"/state/pellucid-batch "$work"/state/pellucid

# The command of a unit, with those folders.
command_of() { # UNIT
    local line
    line=$(sed -n 's/^ExecStart=//p' "$source/packaging/systemd/$1")
    line=${line//%S/$work/state} line=${line//%i/chest} line=${line//"/etc/"/$work/etc/}
    [[ $line == "/usr/bin/pellucid-cli "* ]] || fail "$1 starts: $line"
    echo "${line/"/usr/bin/pellucid-cli"/$cli}"
}

for unit in pellucid-listen.service pellucid-batch@.service; do
    # Only what is installed can be named.
    sed "s#/usr/bin/pellucid-cli#/bin/true#" "$source/packaging/systemd/$unit" >"$work/$unit"
done
if command -v systemd-analyze >/dev/null; then
    said=$(systemd-analyze verify "$work/pellucid-listen.service" "$work/pellucid-batch@.service" 2>&1) || fail "$said"
    [[ -z $said ]] || fail "$said"
fi

"$cli" server add ct --dicom CT1@127.0.0.1:104
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
command=$(command_of pellucid-listen.service)
[[ $command == *" --port 11112 "* ]] || fail "SocketBindAllow is for another port than: $command"
${command/ 11112 / $port } >"$work/said" 2>&1 &
listening=$!
for ((n = 0; n < 200; ++n)); do
    ! grep -qs "listens on .*port $port" "$work/said" || break
    sleep 0.1
done
grep -q "listens on .*port $port" "$work/said" || fail "$(cat "$work/said")"
kill "$listening"
wait "$listening" || fail "the end of the service is no success: $?"

"$cli" phantom "$work/state/pellucid/study" --kind cube --size 16x16x16 >/dev/null
echo '{"recipe": 1, "outputs": [{"name": "front", "view": "front", "size": 32}]}' >"$work/etc/pellucid/chest.json"
for run in first second; do
    $(command_of pellucid-batch@.service) >"$work/said" 2>&1 || fail "$run batch: $(cat "$work/said")"
done
[[ -n $(find "$work/state/pellucid-batch/chest" -name 'front*') ]] || fail "no picture"
