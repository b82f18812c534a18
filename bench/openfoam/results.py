"""Reads what the two programs wrote and measures how far they are apart."""
import cmath
import csv
import glob
import math
import os
import re

from setup import D, R, STATIONS, U0, X_IN, YC

RHO = 1000.0


class Flow:
    """Means and series of one run: profile[station] = (y, u, k), shear = (x, Pa), series = (t, Cd, Cl)."""

    def strouhal(self):
        """Frequency of the lift times D / U0: the largest peak of its spectrum (Hann window)."""
        t, cl = self.series[0], self.series[2]
        n = 4096
        span = t[-1] - t[0]
        even = [interpolate(t, cl, t[0] + span * i / (n - 1)) for i in range(n)]
        mean = sum(even) / n
        windowed = [(c - mean) * (0.5 - 0.5 * math.cos(2 * math.pi * i / (n - 1))) for i, c in enumerate(even)]
        best = (0.0, 0.0)
        f = 2.0 / span
        while f < 3.0:
            turn = cmath.exp(-2j * math.pi * f * span / (n - 1))
            total = 0j
            for c in reversed(windowed):  # Horner
                total = total * turn + c
            best = max(best, (abs(total), f))
            f += 0.1 / span
        return best[1] * D / U0

    def mean(self, column):
        """Time mean (trapezoid) of Cd (1) or Cl (2)."""
        t, c = self.series[0], self.series[column]
        return sum(0.5 * (a + b) * (v - u) for a, b, u, v in zip(c, c[1:], t, t[1:])) / (t[-1] - t[0])

    def rms_lift(self):
        mean, t, c = self.mean(2), self.series[0], self.series[2]
        square = sum(0.5 * ((a - mean)**2 + (b - mean)**2) * (v - u) for a, b, u, v in zip(c, c[1:], t, t[1:]))
        return math.sqrt(square / (t[-1] - t[0]))

    def peak_shear(self):
        """Largest shear within one D of the pipe's centre [Pa] and its x/D."""
        return max((s, x / D) for x, s in zip(*self.shear) if abs(x) <= D)

    def far_shear(self):
        """Mean shear from 8 D to 5 D before the pipe [Pa]."""
        far = [s for x, s in zip(*self.shear) if -8 * D < x < -5 * D]
        return sum(far) / len(far)


def interpolate(xs, ys, x):
    low, high = 0, len(xs) - 1
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if xs[middle] <= x else (low, middle)
    return ys[low] + (ys[high] - ys[low]) * (x - xs[low]) / (xs[high] - xs[low])


def rms_difference(a, b, station):
    """rms over the height of the difference of mean U, over U0, at the rows of a outside the pipe's first 5 %."""
    y, u, _ = a.profile[station]
    z, v, _ = b.profile[station]
    rows = [(yi, ui) for yi, ui in zip(y, u)
            if z[0] <= yi <= z[-1] and math.hypot(station * D, yi - YC) > 1.1 * R]
    weights = [1.0] * len(rows)
    total = sum(w * (ui - interpolate(z, v, yi))**2 for w, (yi, ui) in zip(weights, rows))
    return math.sqrt(total / sum(weights)) / U0


def livebed(folder, start):
    flow = Flow()

    def table(name):
        with open(os.path.join(folder, name)) as f:
            rows = list(csv.reader(f))
        return [[float(r[c]) for r in rows[1:]] for c in range(len(rows[0]))]

    flow.profile = {s: table(f"profile_{n}.csv") for n, s in enumerate(STATIONS)}
    x, shear = table("floor.csv")
    flow.shear = ([a + X_IN for a in x], shear)
    force = 0.5 * RHO * U0**2 * D
    rows = [r for r in zip(*table("series.csv")) if r[0] >= start]
    flow.series = ([r[0] for r in rows], [r[1] / force for r in rows], [r[2] / force for r in rows])
    return flow


def openfoam(case, start):
    flow = Flow()
    last = max((d for d in os.listdir(case) if re.fullmatch(r"[0-9.]+", d)), key=float)
    flow.profile = {}
    for s in STATIONS:
        def samples(name):
            (path,) = glob.glob(f"{glob.escape(case)}/postProcessing/profiles/*/at{s}_{name}.xy")
            return [[float(w) for w in line.split()] for line in open(path)]

        y, u, k = [], [], []
        for cell, slope, energy in zip(samples("C_UMean"), samples("grad(UMean)"), samples("kMean")):
            y.append(cell[0])
            # Linear inside the cell.  Columns: height, x, y, z of the centre, u, ...; height, du/dx, dv/dx, dw/dx,
            # du/dy, ...
            u.append(cell[4] + slope[1] * (s * D - cell[1]) + slope[4] * (cell[0] - cell[2]))
            k.append(energy[1])
        flow.profile[s] = (y, u, k)
    # wallShearStress is the force of the wall on the water over rho.
    tau = [-RHO * v[0] for v in patch_values(f"{case}/{last}/wallShearStressMean", "bed")]
    x = bed_faces(case)
    flow.shear = tuple(zip(*sorted(zip(x, tau))))
    rows = []
    for path in glob.glob(f"{case}/postProcessing/forces/*/coefficient.dat"):
        for line in open(path):
            if not line.startswith("#"):
                w = line.split()
                if float(w[0]) >= start:
                    rows.append((float(w[0]), float(w[1]), float(w[3])))
    flow.series = tuple(zip(*rows))
    return flow


def patch_values(path, patch):
    text = open(path).read()
    text = text[text.index("boundaryField"):]
    text = text[re.search(rf"\n\s*{patch}\s*\n", text).start():]
    text = text[text.index("List<vector>"):]
    text = text[text.index("\n(") + 2:text.index("\n)")]
    return [[float(w) for w in row.split()] for row in re.findall(r"\(([^()]*)\)", text)]


def bed_faces(case):
    mesh = f"{case}/constant/polyMesh"
    text = open(f"{mesh}/boundary").read()
    text = text[re.search(r"\n\s*bed\s*\n", text).start():]
    count, first = (int(re.search(rf"{w}\s+(\d+)", text)[1]) for w in ("nFaces", "startFace"))

    def entries(name):
        body = open(f"{mesh}/{name}").read()
        return re.findall(r"\(([^()]*)\)", body[body.index("\n(") + 2:])

    points, faces = entries("points"), entries("faces")[first:first + count]
    return [sum(float(points[int(p)].split()[0]) for p in f.split()) / len(f.split()) for f in faces]
