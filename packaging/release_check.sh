#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Whether what is committed can be released: each line is a check, the first that fails ends it.
# Takes an hour on two cores with a warm compiler cache, two and a half without; the packages for Windows, once the libraries that
# they need are built, two more. Needs root for the install tests. Called by `./dev release-check`.
set -euo pipefail
cd "$(dirname "$0")/.."
check() { echo "== $*"; }
fail() { echo "release-check: $*" >&2; exit 1; }

check "nothing is uncommitted, and the CHANGELOG has this version"
changes=$(git status --porcelain)
[[ -z $changes ]] || fail "there are changes that are not committed"
version=$(sed -n 's/^project(.* VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[[ $(sed -n 's/^## //p' CHANGELOG.md | head -1) == "$version" ]] || fail "CHANGELOG.md does not begin with $version"

check "format and lint"
./dev lint
check "tests, with the real series, the long soak and a minute of each fuzz target; translations, manual, documents and licences of sources are among them"
[[ -d ${PELLUCID_TEST_DATA:-/none} || -x ../shared/data/unpack ]] || fail "the real series are not there: PELLUCID_TEST_DATA"
./dev test --long 2>&1 | tee build/release-tests.log
if grep -q 'cannot be unpacked' build/release-tests.log; then fail "the real series cannot be unpacked"; fi
# Root may read every folder; there, AFolderOfAnotherUserIsNamed runs in its place.
skipped=$(sed -n 's/^\s*[0-9]* - \(.*\) (Skipped)$/\1/p' build/release-tests.log | grep -v AFolderWithoutPermissionIsNamed || true)
[[ -z $skipped ]] || fail "tests were skipped: $skipped"

check "packages, twice the same: here, and from a clone at another place without what was compiled before"
./dev package
packages=$PWD/build/package/packages
elsewhere=$(mktemp -d)
trap 'rm -rf "$elsewhere"' EXIT
git clone -q . "$elsewhere/somewhere else"
(cd "$elsewhere/somewhere else" && CCACHE_DISABLE=1 ./dev package)
for file in "$packages"/*; do
    cmp "$file" "$elsewhere/somewhere else/build/package/packages/$(basename "$file")" || fail "another build gives another $(basename "$file")"
done

check "the same for Windows, with the libraries that it needs"
./dev windows package
cp -r build/windows/package/packages "$elsewhere/windows"
./dev windows install-test
./dev windows test
(cd "$elsewhere/somewhere else" && CCACHE_DISABLE=1 ./dev windows package)
for file in "$elsewhere"/windows/*; do
    cmp "$file" "$elsewhere/somewhere else/build/windows/package/packages/$(basename "$file")" || fail "another build gives another $(basename "$file")"
done

check "programs are small and linked with nothing that they do not use"
tree=$PWD/build/package/tree
for program in "$tree"/bin/* "$tree"/libexec/pellucid/*; do
    bytes=$(stat -c %s "$program")
    ((bytes < 60 << 20)) || fail "$program has $((bytes >> 20)) MB"
    unused=$(ldd -u "$program" | grep '^[[:space:]]/' || true)
    [[ -z $unused ]] || fail "$program does not use: $unused"
    echo "$(basename "$program"): $((bytes >> 10)) kB"
done

check "programs have what stops an attack on a mistake of memory"
tests/packaging/hardening.sh "$tree"/bin/* "$tree"/libexec/pellucid/*

check "the licences of all that is inside"
sh "$packages"/pellucid-cli-*.run --quiet --noexec --target "$elsewhere/bundle"
for list in build/package/inventory/pellucid.spdx.json build/package/bundle/share/doc/pellucid/pellucid.spdx.json \
    "$elsewhere"/bundle/*/share/doc/pellucid/pellucid.spdx.json; do
    python3 - "$list" <<'PYTHON'
import json, os, pathlib, re, sys
place = pathlib.Path(sys.argv[1])
packages = json.loads(place.read_text())["packages"]
names = [p["name"] for p in packages if p.get("supplier") == "Organization: Debian"]
licences = place.parent / "licences"
missing = [n for n in names if not (licences / n).is_file() or not (licences / n).stat().st_size]
missing += [p["name"] for p in packages if p["name"] not in names and p["licenseDeclared"] == "NOASSERTION"]
if "bundle" in place.parts:  # where there is no Debian to look its common licences up in
    known = "|".join(map(re.escape, sorted(os.listdir("/usr/share/common-licenses"), key=len, reverse=True)))
    named = {n for name in names for n in re.findall(f"common-licenses/({known})", (licences / name).read_text(errors="replace"))}
    missing += [n for n in named if not (licences / "common-licenses" / n).is_file()]
print(f"{place}: {len(names)} packages of others")
sys.exit(f"without licence: {missing}" if missing or len(names) < 10 else 0)
PYTHON
done

check "installing, using, upgrading, removing"
./dev install-test
echo "release-check: $version can be released"
