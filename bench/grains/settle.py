#!/usr/bin/env python3
"""The same lattice of grains settled by LAMMPS, LIGGGHTS and Livebed, and the beds held against each other.

  settle.py BUILD OUT [--figure FILE.svg] [--only SPREAD]...

For every friction and size spread of CASES and every seed the three codes get the same grains at the same places with the same
constants, let them settle in a thick fluid and then without.  A settled bed is one of many: codes agree as well as two
seeds do.  So means over the seeds are compared: height (twice that of the centre of mass), touching grains a grain and
the share of the area below that height that grains fill.  Overlaps, contacts and forces (spring times overlap) are
counted from the places by one and the same function.  What a code has settled is kept in OUT and not run again.
"""
import argparse
import json
import math
import os
import random
import statistics
import sys

import livebed
import peers

D = 2e-3
COUNT = 1560
LENGTH = 60 * 1.06 * D
STEPS, DRAG = 40000, 5e-4  # with that drag on each grain [N s/m], and as many without, at 20 steps a contact
# Friction, size spread and seeds: equal grains crystallise, and their beds differ more from seed to seed.
CASES = [(friction, spread, 8 if spread == 0 else 3) for spread in (0.0, 0.05) for friction in (0.1, 0.3, 0.55)]
CASES.append((0.55, 0.4, 3))  # the largest more than twice the smallest
CODES = ("LAMMPS", "LIGGGHTS", "Livebed")
TARGETS = dict(height=0.005, contacts=0.03, filled=0.01)  # height and contacts relative, share of area absolute


def lattice(spread, seed):
    """Grains at rest on a shaken square lattice: rows of d, x, y, u, v, omega."""
    generator = random.Random(seed)
    rise, room = max(1.06, 1.03 + spread) * D, 0.01 * D
    columns = round(LENGTH / rise - 0.4)
    grains = []
    for i in range(COUNT):
        d = D * (1 + spread * (2 * generator.random() - 1))
        x = (i % columns + 0.5) * LENGTH / columns + room * (2 * generator.random() - 1)
        y = (i // columns + 0.5) * rise + room * (2 * generator.random() - 1)
        grains.append([d, x, y, 0.0, 0.0, 0.0])
    return grains


def settled(code, build, out, friction, spread, seed):
    """Rows of id, d, x, y, u, v, omega of the settled bed, and the spring of two grains."""
    finer = 1 if spread < 0.1 else 3  # the smallest pairs have the shortest contacts
    stages = ((finer * STEPS, DRAG), (finer * STEPS, 0.0))
    params = dict(diameter=D, length=LENGTH, stiffness=5500, steps_per_contact=20 * finer, restitution=0.3,
                  friction=friction, tension="none")
    start = lattice(spread, seed)
    told = livebed.constants(build, params, start)
    folder = f"{out}/{code.lower()}-{friction}-{spread}-{seed}"
    result = f"{folder}/settled.json"
    if not os.path.exists(result):
        os.makedirs(folder, exist_ok=True)
        if code == "Livebed":
            rows = livebed.run(build, params, start, stages)["looks"][-1]["grains"]
        else:
            lammps = code == "LAMMPS"
            peers.write_data(f"{folder}/in.data", start, peers.sphere_density(told), LENGTH, 0.16,
                             types=1 if lammps else 2)
            deck = peers.lammps_deck if lammps else peers.liggghts_deck
            peers.call(folder, "lmp" if lammps else "liggghts", deck(told, 0.2 * D, stages=stages))
            step, rows = peers.read_dump(f"{folder}/out.dump")[-1]
            if step != sum(n for n, _ in stages):  # LIGGGHTS does not always say by its exit code that it gave up
                sys.exit(f"{code} ended at step {step} in {folder}")
            os.remove(f"{folder}/out.dump")
        with open(result, "w") as f:
            json.dump(rows, f)
    with open(result) as f:
        return json.load(f), told["pair"]["k_n"]


def measure(rows, spring):
    """Height [m], touching grains a grain, filled share, mean speed [m/s] and the contact forces over their mean."""
    cell = 1.2 * max(r[1] for r in rows)
    columns = int(LENGTH / cell)
    cell_x = LENGTH / columns
    cells = {}
    for r in rows:
        cells.setdefault((int(r[2] / cell_x) % columns, int(r[3] / cell)), []).append(r)
    forces = []
    for (i, j), here in cells.items():
        for di in (-1, 0, 1):
            for dj in (-1, 0, 1):
                for a in here:
                    for b in cells.get(((i + di) % columns, j + dj), []):
                        if a[0] >= b[0]:
                            continue
                        dx = (b[2] - a[2] + 0.5 * LENGTH) % LENGTH - 0.5 * LENGTH
                        overlap = 0.5 * (a[1] + b[1]) - math.hypot(dx, b[3] - a[3])
                        if overlap > 0:
                            forces.append(spring * overlap)
    volume = sum(r[1]**3 for r in rows)
    height = 2 * sum(r[1]**3 * r[3] for r in rows) / volume
    mean = statistics.mean(forces)
    return dict(height=height, contacts=2 * len(forces) / len(rows),
                filled=sum(math.pi / 4 * r[1]**2 for r in rows) / LENGTH / height,
                speed=statistics.mean(math.hypot(r[4], r[5]) for r in rows), forces=[f / mean for f in forces])


def figure(path, beds):
    """Probability density of the contact forces over their mean, all beds of a code together, as SVG."""
    width, height, left, bottom = 560, 340, 60, 50
    bins, end, low = 30, 6.0, 1e-4
    colours = dict(LAMMPS="#1f77b4", LIGGGHTS="#2ca02c", Livebed="#d62728")

    def at(x, y):
        top = math.log10(2.0)
        return (left + (width - left - 20) * x / end,
                20 + (height - bottom - 20) * (top - math.log10(y)) / (top - math.log10(low)))

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
             f'font-size="12"><rect width="{width}" height="{height}" fill="#fff"/>']
    for x in range(7):
        px, py = at(x, low)
        parts.append(f'<path d="M{px:.1f} {py:.1f}V20" stroke="#ddd"/><text x="{px:.1f}" y="{py + 16:.1f}" '
                     f'text-anchor="middle">{x}</text>')
    for power in range(-4, 1):
        px, py = at(0, 10.0**power)
        parts.append(f'<path d="M{px:.1f} {py:.1f}H{width - 20}" stroke="#ddd"/><text x="{px - 6:.1f}" y="{py + 4:.1f}" '
                     f'text-anchor="end">1e{power}</text>')
    parts.append(f'<text x="{width / 2}" y="{height - 12}" text-anchor="middle">normal force over its mean</text>'
                 f'<text transform="translate(14 {height / 2}) rotate(-90)" text-anchor="middle">probability density</text>')
    for k, code in enumerate(CODES):
        forces = [f for bed in beds[code] for f in bed["forces"]]
        counts = [0] * bins
        for f in forces:
            if f < end:
                counts[int(f / end * bins)] += 1
        points = [((n + 0.5) * end / bins, c * bins / end / len(forces)) for n, c in enumerate(counts) if c > 0]
        line = " ".join("%.1f,%.1f" % at(x, max(y, low)) for x, y in points)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colours[code]}" stroke-width="2"/>'
                     f'<text x="{width - 120}" y="{40 + 18 * k}" fill="{colours[code]}">{code}</text>')
    with open(path, "w") as f:
        f.write("\n".join(parts) + "\n</svg>\n")


def largest_difference_of_shares(a, b):
    """Largest distance of two cumulative distributions (Kolmogorov and Smirnov)."""
    points = sorted([(x, 0) for x in a] + [(x, 1) for x in b])
    share, worst = [0.0, 0.0], 0.0
    for _, which in points:
        share[which] += 1.0 / len((a, b)[which])
        worst = max(worst, abs(share[0] - share[1]))
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("out")
    parser.add_argument("--figure")
    parser.add_argument("--only", type=float, action="append", help="a size spread")
    a = parser.parse_args()
    beds = {code: [] for code in CODES}
    print("| friction | spread | code | height [mm] | off | contacts a grain | off | filled | off | "
          "mean speed [m/s] | forces, largest difference of shares |\n|" + "---|" * 11)
    # "off": Livebed against the code, with the standard error of that difference.
    missed = False
    for friction, spread, seeds in [case for case in CASES if case[1] in (a.only or [case[1]])]:
        means, errors, pooled = {}, {}, {}
        for code in CODES:
            measured = [measure(*settled(code, a.build, a.out, friction, spread, seed + 1)) for seed in range(seeds)]
            beds[code] += measured
            means[code] = {name: statistics.mean(m[name] for m in measured)
                           for name in ("height", "contacts", "filled", "speed")}
            errors[code] = {name: statistics.stdev(m[name] for m in measured) / seeds**0.5 for name in TARGETS}
            pooled[code] = [f for m in measured for f in m["forces"]]
        ours = means["Livebed"]
        for code in CODES:
            m = means[code]
            off = dict(height=ours["height"] / m["height"] - 1, contacts=ours["contacts"] / m["contacts"] - 1,
                       filled=ours["filled"] - m["filled"])
            error = {name: math.hypot(errors[code][name], errors["Livebed"][name]) for name in TARGETS}
            missed |= any(abs(off[name]) > TARGETS[name] for name in TARGETS)
            told = ["" if code == "Livebed" else text
                    for text in (f"{100 * off['height']:+.2f} ({100 * error['height'] / m['height']:.2f}) %",
                                 f"{100 * off['contacts']:+.2f} ({100 * error['contacts'] / m['contacts']:.2f}) %",
                                 f"{off['filled']:+.4f} ({error['filled']:.4f})",
                                 f"{largest_difference_of_shares(pooled[code], pooled['Livebed']):.3f}")]
            print(f"| {friction} | {spread} | {code} | {1e3 * m['height']:.2f} | {told[0]} | {m['contacts']:.3f} |"
                  f" {told[1]} | {m['filled']:.4f} | {told[2]} | {m['speed']:.1e} | {told[3]} |", flush=True)
    if a.figure:
        figure(a.figure, beds)
    sys.exit(7 if missed else 0)


if __name__ == "__main__":
    main()
