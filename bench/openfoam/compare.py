#!/usr/bin/env python3
"""Livebed beside OpenFOAM on the case of setup.py: profiles, drag, shedding, shear on the bed.

  compare.py BUILD OUT [NAME...]    BUILD: folder with mean_flow; OUT: folder of the runs, kept: what is there is not
                                    run again; NAME: of the rows below, all when not given

Prints a Markdown table; differences are against the finest OpenFOAM run of the same Reynolds number.
"""
import os
import subprocess
import sys

import openfoam
import results
import setup
from setup import D, H, STATIONS, U0, X_IN

LENGTH = setup.X_OUT - X_IN
EQUAL = dict(cell_x=LENGTH / 540, cell_y=H / 94)
HALF = dict(cell_x=LENGTH / 1080, cell_y=H / 188)
# The lowest row as high as that of EQUAL (1.858 mm), half as high elsewhere.
HALF_ABOVE = dict(HALF, growth=1.2, fine_y_from=5.6e-3, fine_y_to=H)
HIGH = 190000.0

# name: (what runs, its options).  Means over ten shedding periods or more; OpenFOAM's finer meshes start from the
# coarser one's flow.  nutU is Livebed's smooth law: log law of the speed, viscous below where they meet; nutk takes u*
# from k.
RUNS = {
    "OpenFOAM 9k": ("openfoam", dict(level="coarse", end=20, start=8, wall="nutU")),
    "OpenFOAM 20k": ("openfoam", dict(level="medium", end=13.5, start=2.5, wall="nutU", source="OpenFOAM 9k")),
    "OpenFOAM 52k": ("openfoam", dict(level="fine", end=12, start=2, wall="nutU", source="OpenFOAM 20k")),
    "Livebed 540 x 94": ("livebed", dict(mesh=EQUAL, end=20, start=8)),
    "Livebed 1080 x 186": ("livebed", dict(mesh=HALF_ABOVE, end=16, start=5)),
    "OpenFOAM 9k, pipe's cells 0.93 mm":
        ("openfoam", dict(level="coarse", end=13.5, start=2.5, wall="nutU", at_pipe=0.00093, source="OpenFOAM 9k")),
    "OpenFOAM 9k, nutk": ("openfoam", dict(level="coarse", end=20, start=8)),
    "OpenFOAM 20k, nutk": ("openfoam", dict(level="medium", end=14, start=3, source="OpenFOAM 9k, nutk")),
    "OpenFOAM 9k, nutk, pipe's cells 0.47 mm":
        ("openfoam", dict(level="coarse", end=14, start=3, at_pipe=0.000465, source="OpenFOAM 9k, nutk")),
    "OpenFOAM 9k, nutk, Re 190000": ("openfoam", dict(level="coarse", end=20, start=8, reynolds=HIGH)),
    "OpenFOAM 9k, nutk, Re 190000, pipe's cells 0.47 mm":
        ("openfoam", dict(level="coarse", end=16, start=6, reynolds=HIGH, at_pipe=0.000465,
                          source="OpenFOAM 9k, nutk, Re 190000")),
    "OpenFOAM 9k, nutk, Re 190000, pipe's cells 0.23 mm":
        ("openfoam", dict(level="coarse", end=14, start=4, reynolds=HIGH, at_pipe=0.000233,
                          source="OpenFOAM 9k, nutk, Re 190000, pipe's cells 0.47 mm")),
    "Livebed 540 x 94, Re 190000": ("livebed", dict(mesh=EQUAL, end=20, start=8, reynolds=HIGH)),
    "Livebed 1080 x 188, Re 190000": ("livebed", dict(mesh=HALF, end=16, start=5, reynolds=HIGH)),
}
REFERENCE = {9500.0: "OpenFOAM 52k", HIGH: "OpenFOAM 9k, nutk, Re 190000, pipe's cells 0.23 mm"}


def folder(out, name):
    return os.path.join(out, name.replace(",", "").replace("'", "").replace(" ", "_"))


def run(build, out, name):
    kind, options = RUNS[name]
    options = dict(options)
    where, start = folder(out, name), options["start"]
    if kind == "openfoam":
        if "source" in options:
            run(build, out, options["source"])
            options["source"] = folder(out, options["source"])
        openfoam.run_fitted(where, **options)
        return results.openfoam(where, start)
    if not os.path.exists(f"{where}/floor.csv"):
        setup.use_reynolds(options.pop("reynolds", 9500.0))
        os.makedirs(where, exist_ok=True)
        options.pop("start")
        setup.write_livebed(f"{where}/case.toml", **options)
        subprocess.run([os.path.join(build, "mean_flow"), f"{where}/case.toml", "--from", str(start), "--out", where,
                        "--at", *(str(s * D - X_IN) for s in STATIONS)], check=True, stdout=sys.stderr)
    return results.livebed(where, start)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    build, out = sys.argv[1:3]
    names = sys.argv[3:] or list(RUNS)
    os.makedirs(out, exist_ok=True)
    print("| run | periods | St | mean Cd | mean Cl | rms Cl | largest bed shear, Pa | at x/D |"
          " far upstream, Pa | rms of U - U_ref over U0, %, at x/D = "
          + ", ".join(str(s) for s in STATIONS) + " |\n|" + "---|" * 10)
    for name in names:
        flow = run(build, out, name)
        reference = run(build, out, REFERENCE[RUNS[name][1].get("reynolds", 9500.0)])
        shear, place = flow.peak_shear()
        strouhal = flow.strouhal()
        away = ", ".join(f"{100 * results.rms_difference(flow, reference, s):.1f}" for s in STATIONS)
        periods = strouhal * U0 / D * (flow.series[0][-1] - flow.series[0][0])
        print(f"| {name} | {periods:.0f} | {strouhal:.3f} | {flow.mean(1):.3f} | {flow.mean(2):.3f} |"
              f" {flow.rms_lift():.3f} | {shear:.3f} | {place:.2f} | {flow.far_shear():.4f} | {away} |", flush=True)


main()
