#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that what the manual and the documents point at exists: files beside them, headings,
# pictures that the program contains, and the files of ARCHITECTURE.md's rooms.
# Usage: links.sh SOURCE_ROOT
set -euo pipefail
cd "$1"
python3 - <<'PYTHON'
import pathlib, re, subprocess, sys

wrong = []
listed = subprocess.run(["git", "ls-files", "*.md"], capture_output=True, text=True).stdout.split()
documents = [pathlib.Path(p) for p in listed] or sorted(pathlib.Path(".").glob("*.md"))
anchor = lambda heading: re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
for document in documents:
    text = document.read_text()
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, place = target.partition("#")
        to = document.parent / file if file else document
        if not to.exists():
            wrong.append(f"{document}: {target}")
        elif place and anchor(place) not in {anchor(h) for h in re.findall(r"^#+ (.*)$", to.read_text(), re.M)}:
            wrong.append(f"{document}: no heading {target}")
def exists(name, room):
    return any(any(folder.glob(name)) for folder in (pathlib.Path("."), room))

rooms = re.findall(r"^\| `([^`]+)` \|(.*)$", pathlib.Path("ARCHITECTURE.md").read_text(), re.M)
folders = {str(p) for floor in ("core", "ui", "app") for p in pathlib.Path(floor).iterdir() if p.is_dir()}
wrong += [f"ARCHITECTURE.md: no row for {room}" for room in sorted(folders - {room for room, _ in rooms})]
for room, row in rooms:
    if not pathlib.Path(room).is_dir():
        wrong.append(f"ARCHITECTURE.md: {room} is not a folder")
    for name in re.findall(r"`([\w/*.-]+(?:\.\w+|/[\w-]+))`", row):
        if not exists(name.replace("NAME", "*"), pathlib.Path(room)):
            wrong.append(f"ARCHITECTURE.md: {room} has no {name}")
embedded = set(re.findall(r">(manual/[^<]+)<", pathlib.Path("resources/resources.qrc").read_text()))
shown = set()
for manual in sorted(pathlib.Path("resources/manual").glob("*.html")):
    text = manual.read_text()
    places = set(re.findall(r'(?:id|name)="([^"]+)"', text))
    for target in re.findall(r'(?:href|src)="([^"]+)"', text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, place = target.partition("#")
        if file and f"manual/{file}" not in embedded:
            wrong.append(f"{manual}: {file} is not in resources.qrc")
        if not file and place not in places:
            wrong.append(f"{manual}: no place #{place}")
        shown.add(file)
for picture in embedded:
    name = picture.removeprefix("manual/")
    if not (pathlib.Path("resources") / picture).exists():
        wrong.append(f"resources.qrc: {picture} is not there")
    if name.endswith(".png") and name not in shown:
        wrong.append(f"resources.qrc: nothing shows {picture}")
if len(shown) < 10:
    wrong.append("the manual shows nothing")
print("\n".join(wrong))
sys.exit(bool(wrong))
PYTHON
