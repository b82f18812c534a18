#!/usr/bin/env python3
"""Livebed beside OpenFOAM on the case of setup.py: profiles, drag, shedding, shear on the bed.

  compare.py BUILD OUT [NAME...]    BUILD: folder with mean_flow; OUT: folder of the runs, kept: what is there is not
                                    run again; NAME: of the rows below, all when not given

Prints a Markdown table; RUNS tells what each row is compared with.
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

# Flows with which the others are compared: cells on the pipe as high as the rows of 540 x 94 cells; as those of
# 1080 x 186; at a Reynolds number where wall functions hold.
ROWS_94 = "OpenFOAM 20k"
ROWS_186 = "OpenFOAM 20k, pipe 0.93 mm"
HIGH_RE = "OpenFOAM 9k, nutk, Re 190000, pipe 0.23 mm"

# name: (what runs, with what it is compared, options).  Means over ten shedding periods or more, three on 52k;
# OpenFOAM's finer meshes start from the coarser one's flow.  nutU is Livebed's smooth law: log law of the speed,
# viscous below where they meet; nutk takes u* from k.  "pipe 0.93 mm": height of the cells on the pipe, 1.86 mm
# otherwise; 1.86 mm on the bed in all.  "undamped": epsilon at walls without the paper's factor, as OpenFOAM's.
RUNS = {
    "OpenFOAM 9k": ("openfoam", ROWS_94, dict(level="coarse", end=20, start=8, wall="nutU")),
    "OpenFOAM 20k": ("openfoam", ROWS_94, dict(level="medium", end=13.5, start=2.5, wall="nutU", source="OpenFOAM 9k")),
    "OpenFOAM 52k": ("openfoam", ROWS_94, dict(level="fine", end=4.2, start=1.2, wall="nutU", source="OpenFOAM 20k")),
    "Livebed 540 x 94": ("livebed", ROWS_94, dict(mesh=EQUAL, end=20, start=8)),
    "OpenFOAM 9k, pipe 0.93 mm":
        ("openfoam", ROWS_186,
         dict(level="coarse", end=13.5, start=2.5, wall="nutU", at_pipe=0.00093, source="OpenFOAM 9k")),
    "OpenFOAM 20k, pipe 0.93 mm":
        ("openfoam", ROWS_186,
         dict(level="medium", end=13, start=2, wall="nutU", at_pipe=0.00093, source="OpenFOAM 20k")),
    "Livebed 1080 x 186": ("livebed", ROWS_186, dict(mesh=HALF_ABOVE, end=16, start=5)),
    "Livebed 540 x 94, undamped": ("livebed", ROWS_94, dict(mesh=EQUAL, end=20, start=8, damping=False)),
    "Livebed 1080 x 186, undamped": ("livebed", ROWS_186, dict(mesh=HALF_ABOVE, end=16, start=5, damping=False)),
    "OpenFOAM 9k, nutk": ("openfoam", ROWS_94, dict(level="coarse", end=20, start=8)),
    "OpenFOAM 20k, nutk": ("openfoam", ROWS_94, dict(level="medium", end=14, start=3, source="OpenFOAM 9k, nutk")),
    "OpenFOAM 9k, nutk, pipe 0.47 mm":
        ("openfoam", ROWS_186, dict(level="coarse", end=14, start=3, at_pipe=0.000465, source="OpenFOAM 9k, nutk")),
    "OpenFOAM 9k, nutk, Re 190000": ("openfoam", HIGH_RE, dict(level="coarse", end=20, start=8, reynolds=HIGH)),
    "OpenFOAM 9k, nutk, Re 190000, pipe 0.47 mm":
        ("openfoam", HIGH_RE, dict(level="coarse", end=16, start=6, reynolds=HIGH, at_pipe=0.000465,
                                      source="OpenFOAM 9k, nutk, Re 190000")),
    HIGH_RE: ("openfoam", HIGH_RE, dict(level="coarse", end=14, start=4, reynolds=HIGH, at_pipe=0.000233,
                                              source="OpenFOAM 9k, nutk, Re 190000, pipe 0.47 mm")),
    "Livebed 540 x 94, Re 190000": ("livebed", HIGH_RE, dict(mesh=EQUAL, end=20, start=8, reynolds=HIGH)),
    "Livebed 1080 x 188, Re 190000": ("livebed", HIGH_RE, dict(mesh=HALF, end=16, start=5, reynolds=HIGH)),
}


def folder(out, name):
    return os.path.join(out, name.replace(",", "").replace(" ", "_"))


def run(build, out, name):
    kind, _, options = RUNS[name]
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
          " far upstream, Pa | rms difference of U over U0, %, at x/D = "
          + ", ".join(str(s) for s in STATIONS) + " |\n|" + "---|" * 10)
    for name in names:
        flow = run(build, out, name)
        reference = run(build, out, RUNS[name][1])
        shear, place = flow.peak_shear()
        strouhal = flow.strouhal()
        away = ", ".join(f"{100 * results.rms_difference(flow, reference, s):.1f}" for s in STATIONS)
        periods = strouhal * U0 / D * (flow.series[0][-1] - flow.series[0][0])
        print(f"| {name} | {periods:.0f} | {strouhal:.3f} | {flow.mean(1):.3f} | {flow.mean(2):.3f} |"
              f" {flow.rms_lift():.3f} | {shear:.3f} | {place:.2f} | {flow.far_shear():.4f} | {away} |", flush=True)


if __name__ == "__main__":
    main()
