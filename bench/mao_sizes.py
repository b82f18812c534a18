#!/usr/bin/python3
"""What the size of the grains changes: runs of Mao's experiment with his sand and with larger grains, side by side.

  bench/mao_sizes.py docs/validation --figure docs/validation/mao-sizes.svg

Reads what `livebed validate mao`, `mao-0.7mm`, `mao-1mm` and `mao-2mm-livebed` have left in the folder (NAME.json,
NAME-depth.csv, NAME-profiles.csv); sizes that have not been run are left out.  Times are those of Mao's clock: of larger
grains they are scaled by T, which goes as d^-1.5.  Prints a table of sizes (means over the seeds, their range in brackets) and one
of runs.
"""
import argparse
import collections
import csv
import json
import math
import pathlib
import statistics

SIZES = [("mao", 0.36), ("mao-0.7mm", 0.7), ("mao-1mm", 1.0), ("mao-2mm-livebed", 2.0)]  # [mm]
MAO_T = 11.5, 11.5456  # of his experiment [s]: as `livebed validate` takes it, and by the formula that gives T of others
PLATEAU, SPANS = 0.91, [(1, 12), (1, 25), (1, 37)]  # of Mao's hole; where S/D is held against his
WINDOWS = [(0.5, 1.5), (1.5, 2.5), (3.5, 4.5), (7, 9), (10, 12), (16.5, 19.5), (23.5, 26.5), (30, 37)]  # of Mao's clock [s]
DATA = pathlib.Path(__file__).parent.parent / "data"
COLOURS = ["#000000", "#1f77b4", "#2ca02c", "#d62728"]


def rows(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Runs:
    """All seeds with one size of grains."""

    def __init__(self, folder, name, d):
        self.d = d
        scale = 1.0 if name == "mao" else (d / SIZES[0][1]) ** 1.5 * MAO_T[0] / MAO_T[1]
        self.depth = collections.defaultdict(list)  # seed: [(t, S/D), ...]
        for row in rows(folder / f"{name}-depth.csv"):
            self.depth[int(row["seed"])].append((float(row["t_s"]) * scale, float(row["S_over_D"])))
        self.bed = collections.defaultdict(list)  # (seed, t): [(x/D, y/D), ...]
        for row in rows(folder / f"{name}-profiles.csv"):
            at = int(row["seed"]), round(float(row["t_s"]) * scale)
            self.bed[at].append((float(row["x_D"]), float(row["y_bed_D"])))
        self.skill = collections.defaultdict(dict)  # t: {seed: skill}
        for row in json.loads((folder / f"{name}.json").read_text(encoding="utf-8")):
            for t in (11, 25):
                if f"Brier skill score of the bed at {t} s" in row["name"]:
                    self.skill[t][int(row["name"].split("seed ")[1].split(":")[0])] = row["value"]

    def mean(self, window):
        """Of S/D in a window of time, for each seed that has come to its end."""
        means = []
        for points in self.depth.values():
            if points[-1][0] >= 0.99 * window[1]:
                means.append(statistics.mean(S for t, S in points if window[0] <= t <= window[1]))
        return means


    def rms(self, seed, span, mao):
        """Of S/D about Mao's over a span of time, by the middles of 1000 equal parts; None when the run ends before."""
        points = self.depth[seed]
        if points[-1][0] < 0.999 * span[1]:
            return None
        parts = [span[0] + (n + 0.5) * (span[1] - span[0]) / 1000 for n in range(1000)]
        return statistics.mean((at(points, t) - at(mao, t)) ** 2 for t in parts) ** 0.5

    def time_to(self, seed, level):
        """When the mean of S/D over a second reaches a level."""
        points = self.depth[seed]
        for t, _ in points:
            if statistics.mean(S for at, S in points if abs(at - t) <= 0.5) >= level:
                return t
        return None


def at(points, t):
    """Of [(t, S/D), ...] at a time, by straight lines."""
    after = next((n for n, (when, _) in enumerate(points) if when >= t), len(points) - 1)
    (t0, S0), (t1, S1) = points[max(after - 1, 0)], points[after]
    return S1 if t1 == t0 else S0 + (S1 - S0) * (min(t, t1) - t0) / (t1 - t0)


def each(values, digits):
    return "-" if values is None else f"{values:.{digits}f}"


def told(values):
    if not values:
        return "-"
    text = f"{statistics.mean(values):.2f}"
    return text if len(values) == 1 else f"{text} ({min(values):.2f} to {max(values):.2f})"


def figure(path, runs):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    matplotlib.rcParams["svg.hashsalt"] = "mao_sizes"  # the same file for the same numbers
    picture, axes = pyplot.subplots(2, 2, figsize=(11, 7.5))
    depth, size, early, late = axes.flat
    mao = rows(DATA / "mao1986_livebed_depth.csv")
    depth.plot([float(r["t_s"]) for r in mao], [float(r["S_over_D"]) for r in mao], "k.", label="Mao (1986)")
    for colour, of in zip(COLOURS, runs):
        for n, points in enumerate(of.depth.values()):
            depth.plot(*zip(*points[::5]), color=colour, lw=0.8, label=f"{of.d:g} mm" if n == 0 else None)
    depth.set(xlabel="t, scaled by T [s]", ylabel="S/D", xlim=(0, 40), ylim=(0, 1))
    depth.legend()
    for window, marker in [((10, 12), "o"), ((23.5, 26.5), "s"), ((30, 37), "^")]:
        sizes = [(of.d, value) for of in runs for value in of.mean(window)]
        middle = sum(window) / 2
        line, = size.plot(*zip(*sizes), marker, fillstyle="none", label=f"{window[0]:g} to {window[1]:g} s")
        measured = min(mao, key=lambda r: abs(float(r["t_s"]) - middle))
        size.axhline(float(measured["S_over_D"]), color=line.get_color(), lw=0.8, ls="--")
    size.set(xlabel="grain diameter [mm]", ylabel="S/D (dashed: Mao)", xlim=(0, 2.2), ylim=(0, 1))
    size.legend()
    for axis, t in [(early, 11), (late, 25)]:
        measured = [r for r in rows(DATA / "mao1986_livebed_profiles.csv") if float(r["t_s"]) == t]
        axis.plot([float(r["x_D"]) for r in measured], [float(r["y_bed_D"]) for r in measured], "k.")
        for colour, of in zip(COLOURS, runs):
            for (seed, at), points in of.bed.items():
                if at == t:
                    axis.plot(*zip(*points), color=colour, lw=0.8)
        axis.add_patch(pyplot.Circle((0, 0.5), 0.5, color="#cccccc"))
        axis.set(xlabel="x/D", ylabel="y/D", xlim=(-3, 8), ylim=(-1.1, 1.1), title=f"the bed at {t} s")
    picture.tight_layout()
    picture.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="with the files of `livebed validate`")
    parser.add_argument("--figure", type=pathlib.Path, help="write the figure there, too")
    arguments = parser.parse_args()
    runs = [Runs(arguments.folder, *of) for of in SIZES if (arguments.folder / f"{of[0]}.json").exists()]
    if not runs:
        parser.error(f"no results in {arguments.folder}; `livebed validate mao --grain 1mm` makes some")
    head = ["d [mm]", "seeds"] + [f"{a:g}-{b:g} s" for a, b in WINDOWS] + ["Brier skill 11 s", "25 s"]
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for of in runs:
        cells = [f"{of.d:g}", str(len(of.depth))] + [told(of.mean(w)) for w in WINDOWS]
        print("| " + " | ".join(cells + [told(list(of.skill[t].values())) for t in (11, 25)]) + " |")
    mao = [(float(r["t_s"]), float(r["S_over_D"])) for r in rows(DATA / "mao1986_livebed_depth.csv")]
    cells = [told([statistics.mean([S for t, S in mao if a <= t <= b] or [float("nan")])]) for a, b in WINDOWS]
    print("| Mao | | " + " | ".join(cells) + " | | |\n")

    head = ["d [mm]", "seed", "to [s]"] + [f"rms {a} to {b} s" for a, b in SPANS]
    head += ["63 % of his plateau at [s]", "30 to 37 s", "Brier skill 11 s", "25 s"]
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for of in runs:
        for seed, points in of.depth.items():
            cells = [f"{of.d:g}", str(seed), f"{min(points[-1][0], 37):.1f}"]
            cells += [each(of.rms(seed, span, mao), 3) for span in SPANS]
            cells += [each(of.time_to(seed, (1 - math.exp(-1)) * PLATEAU), 1)]
            late = [S for t, S in points if 30 <= t <= 37]
            cells += [each(statistics.mean(late) if points[-1][0] > 36.9 else None, 2)]
            print("| " + " | ".join(cells + [each(of.skill[t].get(seed), 2) for t in (11, 25)]) + " |")
    if arguments.figure:
        figure(arguments.figure, runs)


if __name__ == "__main__":
    main()
