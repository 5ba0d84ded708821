#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists the third-party components of an installation for Windows (SPDX 2.3, JSON) and collects their licences.

inventory.py TREE VERSION PREFIX LICENCES OUT.spdx.json

What deps.sh has built into PREFIX is inside, as a library or compiled in, and so is what comes from Debian's packages.
"""
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
sys.dont_write_bytecode = True
import spdx

# Not in programs that users run.
TESTS = {"googletest"}
DEBIAN = {
    "gcc-mingw-w64-x86-64-posix-runtime": "libraries of the compiler",
    "mingw-w64-x86-64-dev": "libraries of the compiler",
    "libz-mingw-w64-dev": "a library",
    "libglm-dev": "compiled in", "nlohmann-json3-dev": "compiled in", "libcli11-dev": "compiled in",
    "libeigen3-dev": "compiled in",
    "qt6-translations-l10n": "data",
    "nsis-common": "the installer",
}


def main() -> None:
    tree, version, prefix, licences, out = (pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]),
                                            pathlib.Path(sys.argv[4]), sys.argv[5])
    found = [(*file.name.split("_", 1), file, "a library, or compiled in")
             for file in sorted((prefix / "share/licences").iterdir())]
    for package, comment in DEBIAN.items():
        installed = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], check=True,
                                   capture_output=True, text=True).stdout
        found.append((package, installed, pathlib.Path("/usr/share/doc") / package / "copyright", comment))
    licences.mkdir(parents=True, exist_ok=True)
    components, common = [], set()
    for name, its_version, file, comment in found:
        if name in TESTS:
            continue
        content = file.read_bytes()
        text = content.decode(errors="replace")
        (licences / name).write_bytes(content)
        common |= spdx.common_in(text)
        components.append(spdx.component(name, its_version, text, comment))
    spdx.copy_common(common, licences)
    programs = [p for p in sorted(tree.rglob("*")) if p.suffix in (".exe", ".dll")]
    spdx.write(out, version, programs, components, {c["name"] for c in components})


if __name__ == "__main__":
    main()
