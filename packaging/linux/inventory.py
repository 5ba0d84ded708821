#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists the third-party components of an installed tree (SPDX 2.3, JSON) and collects their licences.

inventory.py TREE VERSION LICENCES OUT.spdx.json

The shared libraries in TREE, and those that its programs are linked with, are looked up in Debian's
package database. The copyright file of each package is copied to the folder LICENCES. If TREE contains
libraries, it also runs on other systems; then the licence texts that those files refer to are copied, too.
"""
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
sys.dont_write_bytecode = True
import spdx


def output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def is_program(path: pathlib.Path) -> bool:
    with path.open("rb") as file:
        return file.read(4) == b"\x7fELF"


def packages_of(paths: list[str]) -> dict[str, str]:
    """The packages that files belong to. Libraries have moved since /lib became a link."""
    candidates = {path: (path, os.path.realpath(path), path.removeprefix("/usr")) for path in paths}
    # One call for all, because each reads the lists of all packages. It fails if a file belongs to none.
    answer = subprocess.run(["dpkg-query", "-S", *sorted(set(sum(candidates.values(), ())))],
                            capture_output=True, text=True).stdout
    owners = {}
    for line in answer.splitlines():
        names, _, path = line.partition(": ")
        owners[path] = names.split(",")[0].split(":")[0]
    return {path: owners[name] for path, names in candidates.items() for name in reversed(names) if name in owners}


def main() -> None:
    tree, version, licences, out = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[4]
    programs = [p for p in sorted(tree.rglob("*")) if p.is_file() and not p.is_symlink() and is_program(p)]
    libraries: dict[str, str] = {}
    for program in programs:
        for line in output("ldd", str(program)).splitlines():
            if found := re.match(r"\s*(\S+) => (/.*) \(0x", line):
                libraries[found[1]] = found[2]
    # A bundled copy belongs to the package that it was copied from.
    system = {name: path for name, path in libraries.items() if not path.startswith(str(tree.resolve()))}
    for name in libraries.keys() - system.keys():
        for folder in ("/usr/lib/x86_64-linux-gnu", "/lib/x86_64-linux-gnu", "/usr/lib", "/lib"):
            if os.path.exists(f"{folder}/{name}"):
                system[name] = f"{folder}/{name}"
                break
        else:
            sys.exit(f"inventory: unknown origin of {name}")
    # Plugins are loaded at run time: no program is linked with them.
    if (tree / "plugins").is_dir():
        plugins = output("/usr/lib/qt6/bin/qtpaths", "--query", "QT_INSTALL_PLUGINS").strip()
        for program in programs:
            if tree / "plugins" in program.parents:
                system[program.name] = f"{plugins}/{program.relative_to(tree / 'plugins')}"
    by_package: dict[str, list[str]] = {}
    owners = packages_of(list(system.values()))
    for name, path in sorted(system.items()):
        if path not in owners:
            sys.exit(f"inventory: {path} belongs to no package")
        by_package.setdefault(owners[path], []).append(name)
    # Compiled in: header-only libraries, or mostly so.
    if (tree / "translations").is_dir():
        by_package.setdefault("qt6-translations-l10n", [])
    for header_only in ("libglm-dev", "nlohmann-json3-dev", "libcli11-dev", "libinsighttoolkit5-dev", "libhwy-dev"):
        by_package.setdefault(header_only, [])

    brought = {package for package, names in by_package.items()
               if not names or any(path.is_file() for name in names for path in tree.rglob(name))}
    licences.mkdir(parents=True, exist_ok=True)
    packages = []
    common: set[str] = set()
    for package, names in sorted(by_package.items()):
        text = (pathlib.Path("/usr/share/doc") / package / "copyright").read_bytes()
        (licences / package).write_bytes(text)
        common |= spdx.common_in(text.decode(errors="replace"))
        packages.append(spdx.component(package, output("dpkg-query", "-W", "-f=${Version}", package),
                                       text.decode(errors="replace"),
                                       "libraries: " + ", ".join(names) if names else "compiled in, or data"))
    if (tree / "lib").is_dir():
        spdx.copy_common(common, licences)
    spdx.write(out, version, programs, packages, brought)


if __name__ == "__main__":
    main()
