#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the rooms and what each may use, from the list that CMake writes.

A room is on a floor above everything it links. Arrows that follow from others are left out.
Usage: diagram.py ROOMS SVG [--check]: writes the file, or compares with it.
"""
import collections
import pathlib
import sys

rooms_file, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])

COLORS = {"core": "#dce9f5", "gpu": "#e6dcf3", "ui": "#e2f0dc", "app": "#f6e8d2"}
WIDTH, ROW, BOX_HEIGHT, GAP, MARGIN = 1240, 62, 26, 14, 16

folder_of, links_of = {}, {}
for line in rooms_file.read_text().splitlines():
    folder, target, links, _ = line.split(" ")
    if folder == "app":  # one header that the programs share
        continue
    folder_of[target] = folder
    links_of[target] = links.split(",")
uses = collections.defaultdict(set)
for target, links in links_of.items():
    uses[folder_of[target]] |= {folder_of[link] for link in links if link in folder_of} - {folder_of[target]}
rooms = sorted(set(folder_of.values()))


def below(room):
    """Everything that a room uses, directly or not."""
    seen, waiting = set(), list(uses[room])
    while waiting:
        here = waiting.pop()
        if here not in seen:
            seen.add(here)
            waiting += uses[here]
    return seen


everything_below = {room: below(room) for room in rooms}
arrows = sorted(
    (room, other)
    for room in rooms
    for other in uses[room]
    if not any(other in everything_below[between] for between in uses[room] - {other})
)
floor = {}
for room in sorted(rooms, key=lambda r: len(everything_below[r])):
    floor[room] = max((floor[other] + 1 for other in uses[room]), default=0)
# Rooms of the window are placed as close below their users as possible.
for room in sorted(rooms, key=lambda r: -floor[r]):
    users = [floor[other] for other in rooms if room in uses[other]]
    if room.startswith("ui/") and users:
        floor[room] = min(users) - 1

# A long arrow gets a place on every floor that it crosses, so that it passes between the boxes.
floors = collections.defaultdict(list)
for room in rooms:
    floors[floor[room]].append(room)
paths, neighbours = [], collections.defaultdict(list)
for high, low in arrows:
    path = [high] + [(high, low, level) for level in range(floor[high] - 1, floor[low], -1)] + [low]
    for place in path[1:-1]:
        floors[place[2]].append(place)
    for upper, lower in zip(path, path[1:]):
        neighbours[upper].append(lower)
        neighbours[lower].append(upper)
    paths.append(path)


def width(place):
    return 7.2 * len(place) + 18 if isinstance(place, str) else 4


def spread(row):
    """Centres of a row's places, evenly over the width."""
    free = (WIDTH - 2 * MARGIN - sum(width(place) for place in row)) / (len(row) + 1)
    left, centres = MARGIN, {}
    for place in row:
        left += free
        centres[place] = left + width(place) / 2
        left += width(place)
    return centres


def settled(row, wanted):
    """Centres as near to what is wanted as the order and the widths allow."""
    def pushed(order, sign):
        at, edge = {}, None
        for place in order:
            here = sign * wanted[place]
            at[place] = here if edge is None else max(here, edge + GAP + width(place) / 2)
            edge = at[place] + width(place) / 2
        return {place: sign * centre for place, centre in at.items()}

    # Both pushes keep the distances between the places, and so does their mean.
    right, left = pushed(row, 1), pushed(row[::-1], -1)
    centres = {place: (right[place] + left[place]) / 2 for place in row}
    return centres


# The places of a floor are ordered by where their neighbours are, until nothing moves.
x = {}
for row in floors.values():
    x.update(spread(row))
for turn in range(80):
    for level in sorted(floors, reverse=turn % 2 == 0):
        row = floors[level]
        wanted = {p: sum(x[n] for n in neighbours[p]) / len(neighbours[p]) if neighbours[p] else x[p] for p in row}
        row.sort(key=lambda p: (wanted[p], str(p)))
        x.update(settled(row, wanted))

leftmost = min(x[place] - width(place) / 2 for place in x)
x = {place: centre - leftmost + MARGIN for place, centre in x.items()}
WIDTH = round(max(x[place] + width(place) / 2 for place in x) + MARGIN)

top = max(floors)
height = MARGIN * 2 + ROW * top + BOX_HEIGHT


def y(place):
    return MARGIN + ROW * (top - (floor[place] if isinstance(place, str) else place[2]))


svg = [
    f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="13">',
    f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
    '<g fill="none" stroke="#8a94a0" stroke-width="1">',
]
for path in paths:
    drawn = f"M{x[path[0]]:.1f} {y(path[0]) + BOX_HEIGHT}"
    for upper, lower in zip(path, path[1:]):
        y1, y2 = y(upper) + BOX_HEIGHT, y(lower)
        bend = 0.5 * (y2 - y1)
        drawn += f" C{x[upper]:.1f} {y1 + bend:.1f} {x[lower]:.1f} {y2 - bend:.1f} {x[lower]:.1f} {y2}"
        if not isinstance(lower, str):
            drawn += f" V{y2 + BOX_HEIGHT}"
    svg.append(f'<path d="{drawn}"/>')
svg.append("</g>")
for room in rooms:
    left, w = x[room] - width(room) / 2, width(room)
    svg.append(
        f'<rect x="{left:.1f}" y="{y(room)}" width="{w:.1f}" height="{BOX_HEIGHT}" rx="5" '
        f'fill="{COLORS[room.split("/")[0]]}" stroke="#5b6670"/>'
        f'<text x="{x[room]:.1f}" y="{y(room) + 17}" text-anchor="middle" fill="#1c2226">{room}</text>'
    )
svg.append("</svg>")
text = "\n".join(svg) + "\n"

if "--check" not in sys.argv[3:]:
    out.write_text(text)
elif not out.exists() or out.read_text() != text:
    sys.exit(f"{out} does not show the rooms of {rooms_file}: ./dev diagram draws them anew")
