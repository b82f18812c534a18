#!/usr/bin/python3
"""How much sand passes each place of the bed, from bed lines alone: what has gone between two times before a place has
passed it.  Prints the flux beyond that of the approach, bulk volume in D2/s of Mao's clock, for Mao (1986) and for runs.

  bench/mao_flux.py docs/validation/mao-profiles.csv docs/validation/mao-1mm-profiles.csv:4.62

A number after a colon: seconds of Mao's clock in one of the run, for grains larger than his.
"""
import collections
import csv
import pathlib
import sys

PLACES = [0.5 * n for n in range(-4, 17)]  # x/D from the pipe's centre
MAO = pathlib.Path(__file__).parent.parent / "data" / "mao1986_livebed_profiles.csv"


def read(path, scale):
    """{(seed, t): [(x/D, y/D), ...]} of a file with columns t_s, x_D, y_bed_D and perhaps seed; t in Mao's seconds."""
    with open(path, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        lines = collections.defaultdict(list)
        for row in rows:
            lines[row.get("seed", "Mao"), scale * float(row["t_s"])].append((float(row["x_D"]), float(row["y_bed_D"])))
    return {key: sorted(points) for key, points in lines.items()}


def height(points, x):
    """Bed at x, None beyond the line's end; 0 before it begins."""
    if x < points[0][0]:
        return 0.0
    for (xa, ya), (xb, yb) in zip(points, points[1:]):
        if xa <= x <= xb:
            return ya + (yb - ya) * (x - xa) / (xb - xa) if xb > xa else yb
    return None


def flux(before, after, seconds):
    """At PLACES [D2/s]; None where a line has ended."""
    fall, total, result = None, 0.0, []
    for n, x in enumerate(PLACES):
        a, b = (height(before, x) if before else 0.0), height(after, x)
        here = None if a is None or b is None else (a - b) / seconds
        if n and here is not None and fall is not None:
            total += 0.5 * (here + fall) * (x - PLACES[n - 1])
        result.append(None if here is None else total)
        fall = here
    return result


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("from,to,name," + ",".join(f"{x:g}" for x in PLACES))
    for argument in [str(MAO), *sys.argv[1:]]:
        name, _, scale = argument.partition(":")
        path, lines = pathlib.Path(name), read(name, float(scale or 1))
        for seed in sorted({seed for seed, _ in lines}):
            times = sorted(t for s, t in lines if s == seed)
            for start, end in ((0, 11), (11, 25)):
                first = min(times, key=lambda t: abs(t - start))
                last = min(times, key=lambda t: abs(t - end))
                before = None  # the flat bed
                if start:
                    if times[-1] < start + 1:
                        continue
                    before = lines[seed, first]
                values = flux(before, lines[seed, last], last - (first if start else 0))
                label = path.stem + (f" seed {seed}" if path != MAO else "")
                print(f"{first if start else 0:.1f},{last:.1f},{label}," + ",".join("" if v is None else f"{v:.3f}" for v in values))


if __name__ == "__main__":
    main()
