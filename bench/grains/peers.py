"""LAMMPS and LIGGGHTS from Debian's packages, with the constants that Livebed uses.

Both work in three dimensions; the grains stay in the plane z = 0.  A grain's mass is that of a sphere of the inertial
density (added mass included), its weight the submerged one.
"""
import math
import os
import shutil
import subprocess
import sys

# What a result row holds: id, d, x, y, u, v, omega, as grain_run gives it.


def write_data(path, grains, density, length, height, types=1):
    """Start file of both codes.  density(d): what the code must be told so that the mass is right."""
    span = 4 * max(g[0] for g in grains)
    with open(path, "w") as f:
        f.write(f"grains\n\n{len(grains)} atoms\n{types} atom types\n\n0 {length!r} xlo xhi\n{-span!r} {height!r} ylo yhi\n"
                f"{-span!r} {span!r} zlo zhi\n\nAtoms\n\n")
        for i, (d, x, y, *_) in enumerate(grains):
            f.write(f"{i + 1} 1 {d!r} {density(d)!r} {x!r} {y!r} 0\n")
        f.write("\nVelocities\n\n")
        for i, (_, _, _, u, v, omega) in enumerate(grains):
            f.write(f"{i + 1} {u!r} {v!r} 0 0 0 {omega!r}\n")


def read_dump(path):
    """Looks of a dump: [(step, rows)], rows in the order of the ids."""
    looks = []
    with open(path) as f:
        for line in f:
            if line.startswith("ITEM: TIMESTEP"):
                looks.append((int(next(f)), []))
            elif line.startswith("ITEM: NUMBER"):
                count = int(next(f))
            elif line.startswith("ITEM: ATOMS"):
                rows = sorted([float(w) for w in next(f).split()] for _ in range(count))
                looks[-1][1].extend([int(r[0]) - 1, *r[1:]] for r in rows)
    return looks


def call(folder, program, deck, cores=1, mpi=True):
    """Runs the deck in the folder; returns what it printed.  Stops with its end when it fails."""
    if shutil.which(program) is None:
        sys.exit(f"{program} is not installed: apt-get install lammps liggghts")
    with open(f"{folder}/in.{program}", "w") as f:
        f.write(deck)
    command = [program, "-in", f"in.{program}", "-log", "none"]
    if cores > 1 and mpi:
        command = ["mpirun", "-n", str(cores), "--oversubscribe", "--allow-run-as-root", *command]
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace",
                          env=environment)
    if done.returncode != 0:
        sys.exit(f"{program} failed in {folder}:\n{done.stdout[-2000:]}")
    return done.stdout


def lammps_rates(told, kind):
    """Damping rates [1/s] of LAMMPS and LIGGGHTS: dashpots over the reduced mass."""
    reduced = told["mass"] * (0.5 if kind == "pair" else 1.0)
    return told[kind]["eta_n"] / reduced, told[kind]["eta_s"] / reduced


def lammps_deck(told, skin, tension="none", wall=True, stages=((0, 0.0),), every=0, end=""):
    """LAMMPS, gran/hooke/history: stages of (steps, drag) in turn; every: steps between looks into out.dump."""
    limited = "limit_damping" if tension == "none" else ""

    def law(kind):
        c = told[kind]
        normal, tangential = lammps_rates(told, kind)
        return f"hooke/history {c['k_n']!r} {c['k_s']!r} {normal!r} {tangential!r} {c['mu']!r} 1 {limited}"

    lines = [
        "units si", "dimension 2", "atom_style sphere", f"boundary p {'f' if wall else 'p'} p", "newton off",
        "processors * 1 1", "comm_modify vel yes", "read_data in.data", f"neighbor {skin!r} bin",
        "neigh_modify every 1 delay 0 check yes", f"pair_style gran/{law('pair')}", "pair_coeff * *",
        f"timestep {told['step']!r}", "fix move all nve/sphere", "fix plane all enforce2d"
    ]
    if wall:
        lines += [f"fix weight all gravity {told['gravity']!r} vector 0 -1 0",
                  f"fix floor all wall/gran {law('wall')} yplane 0.0 NULL"]
    lines += ["thermo 100000", "thermo_modify lost error norm no"]
    return "\n".join(lines + run_lines(stages, every, "line ")) + f"\n{end}\n"


def liggghts_deck(told, skin, stages=((0, 0.0),), every=0, end="", dimension=3):
    """LIGGGHTS, hooke/stiffness with tangential history; grains are of type 1, the floor of type 2."""
    def table(name, of):
        pair, wall = of("pair"), of("wall")
        return f"fix {name} all property/global {name} peratomtypepair 2 {pair!r} {wall!r} {wall!r} {wall!r}"

    model = "model hooke/stiffness tangential history"
    lines = [
        "atom_style granular", "atom_modify map array", f"dimension {dimension}",
        f"boundary p f {'p' if dimension == 2 else 'f'}", "newton off", "communicate single vel yes", "units si",
        "processors * 1 1", "read_data in.data", f"neighbor {skin!r} bin", "neigh_modify every 1 delay 0 check yes",
        table("kn", lambda kind: told[kind]["k_n"]),
        table("kt", lambda kind: told[kind]["k_s"]),
        table("gamman", lambda kind: lammps_rates(told, kind)[0]),
        table("gammat", lambda kind: lammps_rates(told, kind)[1]),
        table("coefficientFriction", lambda kind: told[kind]["mu"]), f"pair_style gran {model} limitForce on", "pair_coeff * *",
        f"timestep {told['step']!r}", f"fix weight all gravity {told['gravity']!r} vector 0.0 -1.0 0.0",
        f"fix floor all wall/gran {model} primitive type 2 yplane 0.0 limitForce on", "fix move all nve/sphere"
    ]
    if dimension == 2:
        lines += ["fix plane all enforce2d"]
    lines += ["thermo 100000", "thermo_modify lost error norm no"]
    return "\n".join(lines + run_lines(stages, every)) + f"\n{end}\n"


def run_lines(stages, every, word=""):
    """word: what LAMMPS wants before the format and the older LIGGGHTS does not."""
    lines = []
    total = sum(n for n, _ in stages)
    if total > 0:
        lines += [f"dump out all custom {every or total} out.dump id diameter x y vx vy omegaz",
                  f'dump_modify out format {word}"%d %.17g %.17g %.17g %.17g %.17g %.17g"']
    for k, (steps, drag) in enumerate(stages):
        if drag > 0:
            lines += [f"fix drag{k} all viscous {drag!r}"]
        lines += [f"run {steps}"]
        if drag > 0:
            lines += [f"unfix drag{k}"]
    return lines


def sphere_density(told):
    return lambda d: told["density"]


def disk_density(told):
    """LIGGGHTS with `dimension 2` makes pi r^2 rho of it: the same mass."""
    return lambda d: told["density"] * 2.0 / 3.0 * d


def reduced_mass(told, d1, d2):
    m1, m2 = (told["density"] * math.pi / 6 * d**3 for d in (d1, d2))
    return m1 * m2 / (m1 + m2)
