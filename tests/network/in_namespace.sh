#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a program where it sees no network but its own, if this user may do that: servers under test
# listen on all addresses.
if unshare -n true 2>/dev/null; then
    exec unshare -n bash -c 'ip link set lo up 2>/dev/null || exit 1; exec "$@"' _ "$@"
fi
exec "$@"
