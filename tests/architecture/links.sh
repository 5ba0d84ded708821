#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that what the manual and the documents point at exists: files beside them, headings, chapters,
# pictures, and what ARCHITECTURE.md names; and that it names every room.
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
page = pathlib.Path("ARCHITECTURE.md").read_text()
places = re.findall(r"`((?:app|core|gpu|packaging|resources|shaders|tests|ui)[\w/.-]*)`", page)
wrong += [f"ARCHITECTURE.md: there is no {place}" for place in places if not pathlib.Path(place).exists()]
folders = {str(p) for floor in ("core", "ui", "app") for p in pathlib.Path(floor).iterdir() if p.is_dir()}
wrong += [f"ARCHITECTURE.md does not say what {folder} is for" for folder in sorted(folders)
          if not any(place == folder or place.startswith(folder + "/") for place in places)]
shown = set()
pages = sorted(pathlib.Path("resources/manual").glob("*.html"))
for manual in pages:
    text = manual.read_text()
    chapters = re.findall(r'<h3(?: id="([^"]*)")?>(.*?)</h3>', text)
    listed = re.findall(r'<li><a href="#([^"]*)">(.*?)</a></li>', text)
    if chapters != listed:
        wrong.append(f"{manual}: its contents are not its chapters: {set(chapters) ^ set(listed)}")
    for target in re.findall(r'(?:href|src)="([^"]+)"', text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, place = target.partition("#")
        if file and not (manual.parent / file).exists():
            wrong.append(f"{manual}: no file {file}")
        if place and f'id="{place}"' not in (manual.parent / file if file else manual).read_text():
            wrong.append(f"{manual}: no place {target}")
        shown.add(file)
for picture in sorted(pathlib.Path("resources/manual").glob("*.png")):
    if picture.name not in shown and not any(picture.name in document.read_text() for document in documents):
        wrong.append(f"nothing shows {picture}")
if len(shown) < 10:
    wrong.append("the manual shows nothing")
print("\n".join(wrong))
sys.exit(bool(wrong))
PYTHON
