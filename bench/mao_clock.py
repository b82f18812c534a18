#!/usr/bin/python3
"""Which moment of a run is most like each bed that Mao measured, and when his own record of S/D(t) has the depth of that bed.

  bench/mao_clock.py docs/validation/mao-profiles.csv docs/validation/mao-0.7mm-profiles.csv:2.70

A number after a colon: seconds of Mao's clock in one of the run, for grains larger than his.  Prints a table: Brier skill of the
bed (1 - its squared distance from the measured one over that of the flat bed) at the time written on the measured bed, the best
skill of any second of the run and when it is reached; runs that end before have no entry.
"""
import pathlib
import statistics
import sys

from mao_flux import MAO, height, read
from mao_sizes import DATA, rows


def skill(computed, measured):
    pairs = [(height(computed, x), y) for x, y in measured]
    return 1 - statistics.fmean((c - y) ** 2 for c, y in pairs) / statistics.fmean(y**2 for _, y in pairs)


def passes(series, depth):
    """When a record (t, S/D) first comes to a depth, by straight lines between its points; None if it never does."""
    for (ta, a), (tb, b) in zip(series, series[1:]):
        if a < depth <= b:
            return ta + (tb - ta) * (depth - a) / (b - a)
    return None


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    measured = {t: points for (_, t), points in sorted(read(MAO, 1).items(), key=lambda item: item[0][1])}
    record = sorted((float(r["t_s"]), float(r["S_over_D"])) for r in rows(DATA / "mao1986_livebed_depth.csv"))
    for t, points in measured.items():
        under = -height(points, 0)
        when = passes(record, under)
        print(f"bed of {t:g} s: {under:.2f} D under the pipe, {-min(y for _, y in points):.2f} D at most; the record of S/D(t) has "
              + (f"{under:.2f} at {when:.1f} s" if when else f"{max(S for _, S in record):.2f} at most"))
    print("| run | " + " | ".join(f"skill at {t:g} s | best skill | at [s]" for t in measured) + " |")
    print("|---|" + "---|---|---|" * len(measured))
    for argument in sys.argv[1:]:
        name, _, scale = argument.partition(":")
        lines = read(name, float(scale or 1))
        for seed in sorted({seed for seed, _ in lines}):
            cells = []
            for t, points in measured.items():
                of_time = {at: skill(bed, points) for (s, at), bed in lines.items() if s == seed and at > 0}
                if max(of_time) < t - 1:
                    cells += ["", "", ""]
                    continue
                best = max(of_time, key=of_time.get)
                nearest = min(of_time, key=lambda at: abs(at - t))
                last = ", its last" if best == max(of_time) else ""
                cells += [f"{of_time[nearest]:.2f}", f"{of_time[best]:.2f}", f"{best:.1f}{last}"]
            print(f"| {pathlib.Path(name).stem.removesuffix('-profiles')} seed {seed} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
