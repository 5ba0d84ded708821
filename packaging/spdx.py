# SPDX-License-Identifier: GPL-3.0-or-later
"""What the lists of third-party components (SPDX 2.3, JSON) of all systems have in common."""
import hashlib
import json
import os
import pathlib
import re
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


def identifier(text: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def licences_in(copyright_text: str) -> list[str]:
    """The licences that a machine-readable copyright file names; none for other files."""
    return sorted(set(re.findall(r"^License: *(\S+)", copyright_text, re.MULTILINE)))


def common_in(copyright_text: str) -> set[str]:
    """The names of the common licence texts that a copyright file refers to."""
    known = "|".join(map(re.escape, sorted(os.listdir(COMMON), key=len, reverse=True)))
    return set(re.findall(rf"{COMMON}/({known})", copyright_text))


def copy_common(names: set[str], licences: pathlib.Path) -> None:
    (licences / "common-licenses").mkdir(exist_ok=True)
    for name in sorted(names):
        (licences / "common-licenses" / name).write_bytes((COMMON / name).read_bytes())


def component(name: str, version: str, copyright_text: str, comment: str) -> dict:
    found = licences_in(copyright_text)
    return {
        "SPDXID": identifier(name),
        "name": name,
        "versionInfo": version,
        "supplier": "Organization: Debian",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "licenseComments": "named in its copyright file: " + ", ".join(found) if found
                           else "see its copyright file",
        "copyrightText": "NOASSERTION",
        "comment": comment,
    }


def write(out: str, version: str, programs: list[pathlib.Path], components: list[dict], brought: set[str]) -> None:
    """`brought`: the names of the components that are inside; the others are the system's."""
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
    packages = components + [{
        "SPDXID": identifier(name), "name": name, "downloadLocation": place, "filesAnalyzed": False,
        "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": whose,
        "comment": f"scan shown in pictures of the manual: {pictures}",
    } for name, place, licence, whose, pictures in SCANS]
    brought = brought | {scan[0] for scan in SCANS}
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
