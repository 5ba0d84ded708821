#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists the third-party components of an installed tree (SPDX 2.3, JSON) and collects their licences.

inventory.py TREE VERSION LICENCES OUT.spdx.json

The shared libraries in TREE, and those that its programs are linked with, are looked up in Debian's
package database. The copyright file of each package is copied to the folder LICENCES. If TREE contains
libraries, it also runs on other systems; then the licence texts that those files refer to are copied, too.
"""
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time


# The licence texts that Debian's copyright files refer to.
COMMON = pathlib.Path("/usr/share/common-licenses")
# Their licence texts are in the copyright file beside the list.
SCANS = [
    ("Lung-PET-CT-Dx", "https://doi.org/10.7937/TCIA.2020.NNC2-0461", "CC-BY-4.0",
     "2020 Li P. et al., The Cancer Imaging Archive", "chest_*.png"),
    ("dcm_qa_ct", "NOASSERTION", "BSD-2-Clause",
     "2019 Chris Rorden; data of Aliza Medical Imaging", "head_bone.png, head_muscle.png, head_fluid.png"),
]


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


def licences_of(package: str) -> tuple[list[str], pathlib.Path]:
    """The licences that a machine-readable copyright file names (none for other files), and the file."""
    copyright_file = pathlib.Path("/usr/share/doc") / package / "copyright"
    text = copyright_file.read_text(errors="replace")
    return sorted(set(re.findall(r"^License: *(\S+)", text, re.MULTILINE))), copyright_file


def identifier(text: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def main() -> None:
    tree, version, licences, out = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[4]
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
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
    known = "|".join(map(re.escape, sorted(os.listdir(COMMON), key=len, reverse=True)))
    for package, names in sorted(by_package.items()):
        found, copyright_file = licences_of(package)
        (licences / package).write_bytes(copyright_file.read_bytes())
        common.update(re.findall(rf"{COMMON}/({known})", copyright_file.read_text(errors="replace")))
        packages.append({
            "SPDXID": identifier(package),
            "name": package,
            "versionInfo": output("dpkg-query", "-W", "-f=${Version}", package),
            "supplier": "Organization: Debian",
            "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION",
            "licenseDeclared": "NOASSERTION",
            "licenseComments": "named in its copyright file: " + ", ".join(found) if found
                               else "see its copyright file",
            "copyrightText": "NOASSERTION",
            "comment": "libraries: " + ", ".join(names) if names else "compiled in, or data",
        })
    if (tree / "lib").is_dir():
        (licences / "common-licenses").mkdir(exist_ok=True)
        for name in sorted(common):
            (licences / "common-licenses" / name).write_bytes((COMMON / name).read_bytes())
    packages += [{
        "SPDXID": identifier(name), "name": name, "downloadLocation": place, "filesAnalyzed": False,
        "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": whose,
        "comment": f"scan shown in pictures of the manual: {pictures}",
    } for name, place, licence, whose, pictures in SCANS]
    brought.update(scan[0] for scan in SCANS)
    own = {
        "SPDXID": "SPDXRef-pellucid", "name": "pellucid", "versionInfo": version,
        "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
        "licenseConcluded": "GPL-3.0-or-later", "licenseDeclared": "GPL-3.0-or-later",
        "copyrightText": "The Pellucid developers",
    }
    digest = hashlib.sha256()
    for program in programs:
        digest.update(program.read_bytes())
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"pellucid-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/pellucid-{version}-{digest.hexdigest()[:32]}",
        "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(epoch)),
                         "creators": ["Tool: inventory.py"]},
        "packages": [own, *packages],
        "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES",
                           "relatedSpdxElement": "SPDXRef-pellucid"}]
                         + [{"spdxElementId": "SPDXRef-pellucid", "relationshipType": "CONTAINS" if p["name"] in brought else "DEPENDS_ON",
                             "relatedSpdxElement": p["SPDXID"]} for p in packages],
    }
    pathlib.Path(out).write_text(json.dumps(document, indent=1) + "\n")
    print(f"inventory: {len(programs)} programs and libraries, {len(packages)} third-party packages")


if __name__ == "__main__":
    main()
