#!/usr/bin/env python3
"""Two grains collide in LAMMPS and in Livebed, step by step.

  collision.py BUILD OUT

At 2000 steps a contact.  LAMMPS gives velocities at the instants of the positions, Livebed between them, so Livebed's
are averaged over the two neighbours.  Prints the largest difference over the whole collision: of places over the
largest overlap, of velocities (spins times the radius) over the speed of approach.
"""
import os
import sys

import livebed
import peers

D = 2e-3
SPEED = 0.2
STEPS = 2600

# name: restitution, friction, tension, spin of the first grain [1/s], target of the difference, and the diameter of the
# other grain over the first's where it is another one; dashpots then follow the reduced mass (contact.law = hooke)
CASES = {
    "head on, damped, the dashpot may pull": (0.5, 0.0, "spring", 0.0, 1e-6),
    "oblique, undamped, slips and sticks, the dashpot may pull": (1.0, 0.2, "spring", -60.0, 1e-6),
    "oblique, undamped, sticks, the dashpot may pull": (1.0, 5.0, "spring", -60.0, 1e-6),
    "oblique, damped, sticks, no pull": (0.5, 5.0, "none", -60.0, 1e-6),
    "oblique, damped, slips throughout, no pull": (0.5, 0.05, "none", -400.0, 1e-6),
    "head on, unequal, damped, the dashpot may pull": (0.5, 0.0, "spring", 0.0, 1e-6, 0.6),
    "oblique, unequal, undamped, slips and sticks, the dashpot may pull": (1.0, 0.2, "spring", -60.0, 1e-6, 0.6),
    "oblique, unequal, damped, sticks, no pull": (0.5, 5.0, "none", -60.0, 1e-6, 0.6),
    "oblique, damped, slips and sticks, no pull": (0.5, 0.2, "none", -60.0, None),
    "oblique, damped, slips and sticks, the dashpot may pull": (0.5, 0.2, "spring", -60.0, None),
}


def grains(spin, oblique, ratio=1.0):
    """One grain flies at another, 0.4 of their mean diameter off its axis where it is oblique."""
    mean = 0.5 * (1 + ratio) * D
    off = 0.4 * mean if oblique else 0.0
    apart = (mean**2 - off**2)**0.5 * 1.0005
    return [[D, 0.05, 0.05, SPEED, 0.0, spin], [ratio * D, 0.05 + apart, 0.05 + off, 0.0, 0.0, 0.0]]


def of_this_pair(told, ratio):
    """The constants with the dashpots that Hooke's law gives this pair, and its reduced mass as that of equal grains."""
    reduced = peers.reduced_mass(told, D, ratio * D)
    grown = (2 * reduced / told["mass"])**0.5
    pair = dict(told["pair"], eta_n=told["pair"]["eta_n"] * grown, eta_s=told["pair"]["eta_s"] * grown)
    return dict(told, pair=pair, mass=2 * reduced)


def difference(build, out, restitution, friction, tension, spin, ratio=1.0):
    params = dict(diameter=D, length=0.1, stiffness=5500, steps_per_contact=2000, gravity=0, restitution=restitution,
                  friction=friction, tension=tension, law="paper" if ratio == 1.0 else "hooke")
    start = grains(spin, friction > 0, ratio)
    told = livebed.run(build, params, start, [(STEPS, 0.0)], every=1)
    os.makedirs(out, exist_ok=True)
    peers.write_data(f"{out}/in.data", start, peers.sphere_density(told), 0.1, 0.1)
    peers.call(out, "lmp", peers.lammps_deck(of_this_pair(told, ratio), D, tension, wall=False, stages=((STEPS, 0.0),), every=1))
    ours = [look["grains"] for look in told["looks"]]
    theirs = [rows for _, rows in peers.read_dump(f"{out}/out.dump")][1:]  # without the start
    overlap = max(0.5 * (a[1] + b[1]) - ((a[2] - b[2])**2 + (a[3] - b[3])**2)**0.5 for a, b in ours)
    place = speed = 0.0
    for n in range(STEPS - 1):
        for i in range(2):
            now, after, other = ours[n][i], ours[n + 1][i], theirs[n][i]
            place = max(place, *(abs(now[k] - other[k]) / overlap for k in (2, 3)))
            scale = [1, 1, 0.5 * D]
            speed = max(speed, *(abs(0.5 * (now[4 + k] + after[4 + k]) - other[4 + k]) * scale[k] / SPEED
                                 for k in range(3)))
    return place, speed, overlap / D


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    build, out = sys.argv[1:]
    missed = False
    print("| collision | largest overlap / d | places | velocities | target |\n|---|---|---|---|---|")
    for name, (restitution, friction, tension, spin, target, *ratio) in CASES.items():
        place, speed, overlap = difference(build, out, restitution, friction, tension, spin, *ratio)
        verdict = "told, not judged" if target is None else f"{target:g}: " + ("pass" if max(place, speed) < target else "**miss**")
        missed |= target is not None and max(place, speed) >= target
        print(f"| {name} | {overlap:.4f} | {place:.1e} | {speed:.1e} | {verdict} |", flush=True)
    sys.exit(7 if missed else 0)


if __name__ == "__main__":
    main()
