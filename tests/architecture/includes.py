#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file includes lies in the link closure of its room's library.

CMake writes the rooms: folder, target, links, public links. A file may include headers of its own room, of the
rooms that its room links, and of those that these link publicly; the same holds for libraries of others.
Usage: includes.py SOURCE_ROOT ROOMS
"""
import collections
import pathlib
import re
import sys

root, rooms_file = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])

# An include of another project: the target that it needs, and the ending of the files that may have it, if only such may.
THIRD_PARTY = [
    (r"tbb/", r"TBB::tbb", None),
    (r"fmt/", r"fmt::fmt", None),
    (r"glm/", r"glm::glm", None),
    (r"CLI/", r"CLI11::CLI11", None),
    (r"hwy/", r"pellucid_highway", None),
    (r"Q[A-Z]", r"Qt6::\w+", None),
    (r"nlohmann/", r"nlohmann_json::nlohmann_json", "nlohmann"),
    (r"dcmtk/", r"DCMTK::DCMTK", "dcmtk"),
    (r"itk", r"ITK\w+", "itk"),
    (r"fftw3", r"PkgConfig::FFTW3F?", "fftw"),
    (r"openjpeg", r"PkgConfig::OPENJPEG", "openjpeg"),
    (r"jxl/", r"PkgConfig::JXL", "libjxl"),
    (r"zlib", r"ZLIB::ZLIB", "zlib"),
    (r"png", r"PNG::PNG", "libpng"),
    (r"archive", r"LibArchive::LibArchive", "libarchive"),
    (r"spdlog/", r"spdlog::spdlog", "spdlog"),
    (r"epoxy/", r"PkgConfig::EPOXY", "epoxy"),
    (r"seccomp", r"PkgConfig::SECCOMP", "seccomp"),
    (r"xxhash", r"PkgConfig::XXHASH", "xxhash"),
]
# What the operating system offers; `core/platform` alone may use it.
SYSTEM = re.compile(r"(sys|linux|netinet|arpa|net)/|(unistd|fcntl|poll|pthread|sched|signal|spawn|netdb|pwd|grp|dlfcn|termios|dirent|"
                    r"syslog|ifaddrs|langinfo|iconv|strings|malloc|io|windows|winsock2|ws2tcpip)\.h$")
# Headers may include only these: GLM everywhere, and Qt in the rooms of the window.
IN_HEADERS = {r"glm/": "", r"Q[A-Z]": "ui/"}

Room = collections.namedtuple("Room", "target links")
rooms = collections.defaultdict(list)
public = {}
for line in rooms_file.read_text().splitlines():
    folder, target, links, publicly = line.split(" ")
    rooms[folder].append(Room(target, links.split(",")))
    public[target] = publicly.split(",")


def closure(links):
    """The links, and what they link publicly."""
    seen, waiting = set(), list(links)
    while waiting:
        target = waiting.pop()
        if target not in seen:
            seen.add(target)
            waiting += public.get(target, [])
    return seen


def everything(target):
    """What a program is linked with, privately too."""
    of = {room.target: room.links for several in rooms.values() for room in several}
    seen, waiting = set(), [target]
    while waiting:
        here = waiting.pop()
        if here not in seen:
            seen.add(here)
            waiting += of.get(here, []) + public.get(here, [])
    return seen


def room_of(path):
    folders = [folder for folder in rooms if path.startswith(folder + "/")]
    return max(folders, key=len, default=None)


wrong = []
sources = sorted(p for top in ("app", "core", "gpu", "ui") for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp", ".inc"))
if len(sources) < 300 or len(rooms) < 30:
    wrong.append("where are the sources?")
for source in sources:
    path = source.relative_to(root).as_posix()
    folder = room_of(path)
    if folder is None:
        wrong.append(f"{path}: its folder is no room; add it to a CMakeLists.txt by pellucid_room")
        continue
    links = [link for room in rooms[folder] for link in room.links]
    allowed = closure(links)
    for number, line in enumerate(source.read_text().splitlines(), 1):
        include = re.match(r'\s*#\s*include\s*([<"])([^>"]+)', line)
        if not include:
            continue
        place, what = f"{path}:{number}", include[2]
        if include[1] == '"' and what.split("/")[0] in ("app", "core", "gpu", "ui", "tests"):
            other = room_of(what)
            if other == folder:
                continue
            if other is None or not any(room.target in allowed for room in rooms[other]):
                wrong.append(f"{place}: includes {what}, but {rooms[folder][0].target} does not link {other or what}")
            if "_nlohmann.h" in what and "_nlohmann." not in path and not path.startswith("app/"):
                wrong.append(f"{place}: {what} is for *_nlohmann.cpp")
            continue
        if SYSTEM.match(what) and not path.startswith("core/platform/"):
            wrong.append(f"{place}: includes <{what}>, which only core/platform may")
            continue
        for pattern, target, ending in THIRD_PARTY:
            if not re.match(pattern, what):
                continue
            if target and not any(re.fullmatch(target, link) for link in allowed):
                wrong.append(f"{place}: includes <{what}>, but {rooms[folder][0].target} does not link {target}")
            # Programs may use JSON in any file.
            if ending and not re.search(rf"_{ending}\.(cpp|h|inc)$", path) and not (ending == "nlohmann" and path.startswith("app/")):
                wrong.append(f"{place}: includes <{what}>, which only *_{ending}.cpp may")
            if path.endswith(".h") and "_nlohmann.h" not in path and not path.startswith("app/"):
                top = IN_HEADERS.get(pattern)
                if top is None or not path.startswith(top):
                    wrong.append(f"{place}: a header names <{what}>")
            break

# Untrusted bytes are parsed in confined processes; the bench runs on machines without Qt, DCMTK and ITK.
for folder, several in rooms.items():
    for room in several:
        linked = everything(room.target)
        for process, program in (("pellucid_decoding_process", "pellucid-decode"), ("pellucid_network_process", "pellucid-net")):
            if process in linked and room.target not in (process, program):
                wrong.append(f"{room.target} links {process}, which is for {program} alone")
        if room.target == "pellucid-net":
            codecs = [link for link in linked if re.search(r"pellucid_dcmtk|JXL|OPENJPEG|LibArchive|CharLS|ITK", link, re.I)]
            wrong += [f"pellucid-net links {link}: what reads a server's bytes has no codecs" for link in codecs]
        if folder == "app/bench":
            wrong += [f"{room.target} links {link}" for link in linked if re.match(r"Qt6|DCMTK|ITK", link)]

# The SPDX line is one of the first three, after an interpreter or version line.
suffixes = (".h", ".cpp", ".inc", ".glsl", ".comp", ".vert", ".frag", ".sh", ".py")
for top in ("app", "core", "gpu", "ui", "tests", "shaders", "packaging"):
    for source in sorted((root / top).rglob("*")):
        if source.suffix in suffixes and not re.search(
            r"^(//|#) SPDX-License-Identifier: GPL-3.0-or-later$", "\n".join(source.read_text().splitlines()[:3]), re.M
        ):
            wrong.append(f"{source.relative_to(root)} has no SPDX line")

print("\n".join(wrong))
sys.exit(bool(wrong))
