#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pellucid beside what a user would install instead: pictures by plastimatch and VTK.

Each program makes a turntable of a study as picture files, in turns. Pellucid reads the study, and
its time contains the check of its own errors; the others read the field of the study, from 0 to 1.
Plastimatch makes pictures in perspective. Each program is measured against its own model: Pellucid by
its own check, the worst picture that it checks; plastimatch's first picture against exact sums of
constant voxels along its own rays; VTK's against sums of trilinear samples, up to a factor, because
it shows no units.

Needs Debian's python3-numpy, plastimatch and python3-vtk9, and a display for VTK. A program that is
missing is left out."""

import argparse
import importlib.util
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

RAYS = 400  # of random pixels; errors vary by a twentieth with the seed
SEED = 1


class Field:
    """The field as an NRRD of floats: values[k, j, i], axes along x, y and z."""

    def __init__(self, path):
        head, _, data = pathlib.Path(path).read_bytes().partition(b"\n\n")
        lines = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line)
        self.size = [int(n) for n in lines["sizes"].split()]
        vectors = [[float(x) for x in v.strip("()").split(",")] for v in lines["space directions"].split()]
        if np.count_nonzero(vectors) != 3 or any(vectors[d][d] <= 0 for d in range(3)):
            sys.exit("peers.py: the slices are tilted or turned, which plastimatch does not read")
        self.spacing = np.array([vectors[d][d] for d in range(3)])
        self.origin = np.array([float(x) for x in lines["space origin"].strip("()").split(",")])
        self.values = np.frombuffer(data, "<f4").reshape(self.size[::-1]).astype(float)

    @property
    def center(self):
        return self.origin + 0.5 * (np.array(self.size) - 1) * self.spacing

    def box_sum(self, source, direction):
        """The exact integral of constant voxels along a ray (Siddon 1985)."""
        low = self.origin - 0.5 * self.spacing
        cuts = []
        for d in range(3):
            if direction[d] != 0:
                cuts.append((low[d] + np.arange(self.size[d] + 1) * self.spacing[d] - source[d]) / direction[d])
        t = np.sort(np.concatenate(cuts))
        middle = source + 0.5 * (t[1:] + t[:-1])[:, None] * direction
        at = np.floor((middle - low) / self.spacing).astype(int)
        inside = np.all((at >= 0) & (at < self.size), axis=1)
        i, j, k = at[inside].T
        return float(np.dot(self.values[k, j, i], np.diff(t)[inside]) * np.linalg.norm(direction))

    def trilinear_sum(self, source, direction, step=0.05):
        """Trilinear samples along a ray, every `step` of the shortest side of a voxel: a tenth of
        that step changes the sum by less than 1e-4."""
        reach = 0.5 * float(np.linalg.norm(np.array(self.size) * self.spacing))
        unit = direction / np.linalg.norm(direction)
        nearest = float(np.dot(self.center - source, unit))
        length = step * float(self.spacing.min())
        t = np.arange(nearest - reach, nearest + reach, length)
        x = (source + t[:, None] * unit - self.origin) / self.spacing
        first = np.floor(x).astype(int)
        inside = np.all((first >= 0) & (first < np.array(self.size) - 1), axis=1)
        x, first = x[inside], first[inside]
        f = x - first
        total = np.zeros(len(f))
        for c in range(8):
            corner = np.array([c & 1, c >> 1 & 1, c >> 2])
            i, j, k = (first + corner).T
            total += self.values[k, j, i] * np.prod(np.where(corner, f, 1 - f), axis=1)
        return float(total.sum() * length)


def timed(command, environment=None):
    begin = time.monotonic()
    done = subprocess.run(command, env={**os.environ, **(environment or {})}, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"peers.py: {command[0]} failed: {(done.stderr.strip().splitlines() or ['no message'])[-1]}")
    return time.monotonic() - begin, done.stdout


class Pellucid:
    name, model = "Pellucid", "band-limited cubic, its own measurement"

    def __init__(self, program, study, folder, side):
        self.program, self.study, self.folder, self.side = program, study, folder, side

    def run(self, pictures, threads):
        command = [self.program, "render", self.study, "--turntable", "--frames", str(pictures), "--json",
                   "--size", f"{self.side}x{self.side}", "-o", f"{self.folder}/pellucid.png"]
        seconds, out = timed(command + (["--threads", str(threads)] if threads else []))
        self.measured = json.loads(out)["measured_error"]
        return seconds

    def error(self):
        return self.measured["relative_l2"] if self.measured else None


class Plastimatch:
    name, model = "plastimatch drr", "exact sums of constant voxels"

    def __init__(self, field_path, field, folder, side):
        self.field_path, self.field, self.folder, self.side = field_path, field, folder, side

    def run(self, pictures, threads):
        # Its detector is 1.5 times as far as the body, by default.
        extent = 1.5 * float(np.linalg.norm(np.array(self.field.size) * self.field.spacing))
        seconds, _ = timed(
            ["plastimatch", "drr", "-i", "exact", "-P", "none", "-t", "pfm", "-r", f"{self.side} {self.side}",
             "-z", f"{extent} {extent}", "-o", " ".join(str(x) for x in self.field.center), "-a", str(pictures),
             "-N", str(360 / pictures), "-I", self.field_path, "-O", f"{self.folder}/plastimatch_"],
            {"OMP_NUM_THREADS": str(threads)} if threads else None)
        return seconds

    def error(self):
        field = self.field
        data = pathlib.Path(f"{self.folder}/plastimatch_0000.pfm").read_bytes()
        picture = np.frombuffer(data[-4 * self.side * self.side:], "<f4").reshape(self.side, self.side)
        lines = pathlib.Path(f"{self.folder}/plastimatch_0000.txt").read_text().splitlines()
        numbers = [[float(x) for x in line.split()] for line in lines if line[:1] == " "]
        middle, distance = numbers[0], numbers[5][0]
        turn = np.array(numbers[7:11])
        per_mm = numbers[11][0]
        source = -turn[:3, :3].T @ turn[:3, 3]
        exact, shown = [], []
        random = np.random.default_rng(SEED)
        for row, column in random.integers(0, self.side, (RAYS, 2)):
            ray = turn[:3, :3].T @ np.array([(column - middle[1]) / per_mm, (row - middle[0]) / per_mm, distance])
            exact.append(field.box_sum(source, ray))
            shown.append(10 * picture[row, column])  # plastimatch sums in cm
        return relative(shown, exact)


class Vtk:
    name, model = "VTK, additive", "sums of trilinear samples, up to a factor"

    def __init__(self, field_path, field, folder, side):
        self.field_path, self.field, self.folder, self.side = field_path, field, folder, side

    def run(self, pictures, threads):
        # The brightest line along x or y is white.
        white = max(float(self.field.values.sum(axis=2 - d).max()) * self.field.spacing[d] for d in (0, 1))
        command = [sys.executable, __file__, "--vtk", self.field_path, self.folder, str(self.side), str(pictures),
                   str(white)]
        return timed(command, {"LP_NUM_THREADS": str(threads)} if threads else None)[0]

    def error(self):
        field = self.field
        picture = np.load(f"{self.folder}/vtk.npy")
        pixel = field.size[0] * field.spacing[0] / self.side
        exact, shown = [], []
        random = np.random.default_rng(SEED)
        for row, column in random.integers(0, self.side, (RAYS, 2)):
            # The camera is in front; rows go up.
            u = (column - 0.5 * (self.side - 1)) * pixel
            v = (row - 0.5 * (self.side - 1)) * pixel
            exact.append(field.trilinear_sum(field.center + np.array([u, -1000.0, v]), np.array([0.0, 1.0, 0.0])))
            shown.append(float(picture[row, column]))
        exact, shown = np.array(exact), np.array(shown)
        return relative(shown * np.dot(exact, shown) / np.dot(shown, shown), exact)


def relative(shown, exact):
    shown, exact = np.array(shown), np.array(exact)
    return float(np.linalg.norm(shown - exact) / np.linalg.norm(exact))


def render_with_vtk(field_path, folder, side, pictures, white):
    """A process of its own, as a user would write it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
    from vtkmodules.vtkIOImage import vtkNrrdReader, vtkPNGWriter
    from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkRenderer, vtkRenderWindow, vtkVolume,
                                             vtkVolumeProperty, vtkWindowToImageFilter)
    from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLGPUVolumeRayCastMapper

    reader = vtkNrrdReader()
    reader.SetFileName(field_path)
    reader.Update()
    image = reader.GetOutput()
    mapper = vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    mapper.SetBlendModeToAdditive()
    mapper.AutoAdjustSampleDistancesOff()
    step = min(image.GetSpacing())
    mapper.SetSampleDistance(step)
    color, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
    color.AddRGBPoint(0, 1, 1, 1)
    color.AddRGBPoint(1, 1, 1, 1)
    opacity.AddPoint(0, step / white)
    opacity.AddPoint(1, step / white)
    look = vtkVolumeProperty()
    look.SetColor(color)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(step)
    look.SetInterpolationTypeToLinear()
    volume, renderer, window = vtkVolume(), vtkRenderer(), vtkRenderWindow()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    renderer.AddVolume(volume)
    window.SetOffScreenRendering(1)
    window.SetSize(side, side)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(0.5 * image.GetDimensions()[0] * image.GetSpacing()[0])
    middle = image.GetCenter()
    camera.SetFocalPoint(middle)
    camera.SetPosition(middle[0], middle[1] - 1000, middle[2])
    camera.SetViewUp(0, 0, 1)
    for n in range(pictures):
        renderer.ResetCameraClippingRange()
        window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        if n == 0:
            pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
            np.save(f"{folder}/vtk.npy", pixels.reshape(side, side, -1)[:, :, 0])
        writer = vtkPNGWriter()
        writer.SetInputConnection(grab.GetOutputPort())
        writer.SetFileName(f"{folder}/vtk_{n:04d}.png")
        writer.Write()
        camera.Azimuth(360 / pictures)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("study", help="DICOM folder or volume, slices not tilted")
    parser.add_argument("--cli", required=True, help="pellucid-cli")
    parser.add_argument("--pictures", type=int, nargs="*", default=[1, 36])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--side", type=int, default=512, help="pixels")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        field_path = f"{folder}/field.nrrd"
        timed([options.cli, "volume", options.study, "--field", "-o", field_path])
        field = Field(field_path)
        programs = [Pellucid(options.cli, options.study, folder, options.side)]
        if shutil.which("plastimatch"):
            programs.append(Plastimatch(field_path, field, folder, options.side))
        if importlib.util.find_spec("vtkmodules") and "DISPLAY" in os.environ:
            programs.append(Vtk(field_path, field, folder, options.side))
        print(f"{'program':17} {'pictures':>8} {'threads':>7} {'seconds':>8} {'error':>8}  error against")
        for pictures in options.pictures:
            for threads in (1, 0):
                seconds = {program: [] for program in programs}
                for _ in range(options.rounds):
                    for program in programs:
                        seconds[program].append(program.run(pictures, threads))
                for program in programs:
                    error = program.error()
                    print(f"{program.name:17} {pictures:8} {threads or 'all':>7} "
                          f"{statistics.median(seconds[program]):8.2f} "
                          f"{'-' if error is None else format(error, '8.1e'):>8}  {program.model}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--vtk"]:
        render_with_vtk(sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]), float(sys.argv[6]))
    else:
        main()
