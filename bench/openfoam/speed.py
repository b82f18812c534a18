#!/usr/bin/env python3
"""Seconds a step and a simulated second, OpenFOAM and Livebed in turns.

  speed.py BUILD OUT [--pairs N] [--only NAME]...

OpenFOAM: equal Cartesian cells with the pipe as a staircase (2 PISO correctors, GAMG) at 540 x 94 and 1500 x 260;
body-fitted at 52k (3 correctors, 1 non-orthogonal correction).  All start from a developed flow (a coarse body-fitted
run, made in OUT when it is not there), linearUpwind for U, upwind for k and epsilon, Euler in time, Courant number
about 0.85.  Livebed: `livebed bench flow` on as many cells, Courant number 0.85.  1 and 2 cores.  Each line of the
table: median (smallest to largest) over the pairs, and the largest number of cores that other programs kept busy in
the meantime: above 0.1 the line says little.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import time

import openfoam
import setup

# name: mesh, fixed step [s], steps before and in the measured stretch
CASES = {
    "cart50": (("cartesian", 540, 94), 4.5e-3, 8, 40),
    "fit52": (("fitted", "fine"), 1.3e-3, 6, 25),
    "cart390": (("cartesian", 1500, 260), 1.5e-3, 8, 10),
}


def developed(out):
    case = f"{out}/developed"
    openfoam.run_fitted(case, "coarse", end=10, start=9)
    return case


def prepare(out, name):
    """Case folder of the name, mapped from the developed flow and cut in two for MPI; returns its number of cells."""
    case, (mesh, step, _, _) = f"{out}/{name}", CASES[name]
    if not os.path.exists(f"{case}/processor0"):
        setup.use_reynolds(9500.0)
        fitted = mesh[0] == "fitted"
        setup.fitted_mesh(case, mesh[1]) if fitted else setup.cartesian_mesh(case, *mesh[1:])
        setup.write_openfoam(case, correctors=3 if fitted else 2, non_orthogonal=1 if fitted else 0, end=100,
                             scalars="upwind", time="Euler", step=step, fixed_step=True, processes=2)
        openfoam.make_mesh(case)
        openfoam.map_from(case, developed(out))
        openfoam.call(case, "decomposePar")
    with open(f"{case}/constant/polyMesh/owner") as f:
        note = next(line for line in f if "nCells" in line)
    return int(note.split("nCells:")[1].split()[0])


def time_openfoam(out, name, cores):
    """Seconds a step from the wall clock at the ends of steps, and the step and largest Courant number."""
    _, step, skip, count = CASES[name]
    command = ["pimpleFoam"]
    if cores > 1:
        command = ["mpirun", "-n", str(cores), "--oversubscribe", "--allow-run-as-root", "pimpleFoam", "-parallel"]
    job = subprocess.Popen(command, cwd=f"{out}/{name}", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                           env=openfoam.environment())
    ends, courant = [], 0.0
    for line in job.stdout:
        if line.startswith("Courant Number") and len(ends) >= skip:
            courant = max(courant, float(line.split()[-1]))
        if line.startswith("ExecutionTime"):
            ends.append(time.time())
            if len(ends) == skip + count:
                break
    job.terminate()
    job.wait()
    if len(ends) < skip + count:
        sys.exit(f"OpenFOAM {name} ended after {len(ends)} steps")
    return dict(seconds=(ends[-1] - ends[skip - 1]) / count, step=step, courant=courant)


def time_livebed(build, cells, cores):
    command = [os.path.join(build, "livebed"), "--threads", str(cores), "bench", "flow", "--json"]
    text = subprocess.run([*command, "--cells", str(cells)], check=True, stdout=subprocess.PIPE, text=True).stdout
    told = json.loads(text)
    return dict(seconds=told["seconds_per_step"], step=told["step"], courant=told["courant"], cells=told["cells"],
                commit=told["commit"])


def busy():
    """Processor seconds of the machine, and of the processes that have ended below this one."""
    with open("/proc/stat") as f:
        ticks = [int(w) for w in f.readline().split()[1:]]
    user, nice, system, _, _, irq, softirq = ticks[:7]
    own = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (user + nice + system + irq + softirq) / os.sysconf("SC_CLK_TCK"), own.ru_utime + own.ru_stime


def watched(run, *arguments):
    """What run gives, with the cores that others kept busy meanwhile."""
    all_before, own_before = busy()
    start = time.time()
    told = run(*arguments)
    all_after, own_after = busy()
    told["others"] = max(0.0, (all_after - all_before - own_after + own_before) / (time.time() - start))
    return told


def middle(values):
    return f"{statistics.median(values):.4g} ({min(values):.4g} to {max(values):.4g})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("out")
    parser.add_argument("--pairs", type=int, default=3)
    parser.add_argument("--only", action="append", choices=CASES)
    a = parser.parse_args()
    os.makedirs(a.out, exist_ok=True)
    print("| cells | cores | OpenFOAM, s a step | Courant | s a simulated second | Livebed, s a step | Courant |"
          " s a simulated second | faster a step | a simulated second | others, cores |\n|" + "---|" * 11)
    commit = ""
    for name in a.only or CASES:
        cells = prepare(a.out, name)
        # Of a body-fitted grid Livebed has no like: it runs on as many cells.
        wanted = cells if name == "fit52" else CASES[name][0][1] * CASES[name][0][2]
        for cores in (1, 2):
            theirs, ours = [], []
            for pair in range(a.pairs):
                theirs.append(watched(time_openfoam, a.out, name, cores))
                ours.append(watched(time_livebed, a.build, wanted, cores))
                print(f"{name}, {cores} cores, pair {pair + 1}, load average {os.getloadavg()[0]:.2f}\n"
                      f"  OpenFOAM {theirs[-1]}\n  Livebed {ours[-1]}", file=sys.stderr)
            commit = ours[0]["commit"]

            def column(runs, of):
                return [of(r) for r in runs]

            def a_step(r):
                return r["seconds"]

            def a_second(r):
                return r["seconds"] / r["step"]

            ratios = [statistics.median(column(theirs, of)) / statistics.median(column(ours, of))
                      for of in (a_step, a_second)]
            print(f"| {name}: {cells}, {ours[0]['cells']} | {cores} | {middle(column(theirs, a_step))} |"
                  f" {theirs[0]['courant']:.2f} | {middle(column(theirs, a_second))} | {middle(column(ours, a_step))} |"
                  f" {ours[0]['courant']:.2f} | {middle(column(ours, a_second))} | {ratios[0]:.1f} | {ratios[1]:.1f} |"
                  f" {max(column(theirs + ours, lambda r: r['others'])):.2f} |",
                  flush=True)
    print(f"\nLivebed of commit {commit}.")


if __name__ == "__main__":
    main()
