#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs pellucid-cli.exe as if it were a program of this system: for tests.
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/windows
# shellcheck source=wine.sh
source "${BASH_SOURCE[0]%/*}/wine.sh" "$folder/deps"
unset PELLUCID_NET PELLUCID_DECODER # those of this system
for name in XDG_DATA_HOME XDG_CACHE_HOME XDG_CONFIG_HOME; do
    [[ -z ${!name:-} ]] || export "$name=Z:${!name}"
done
exec wine "$folder/release/bin/pellucid-cli.exe" "$@"
