#!/usr/bin/python3
"""What each part of the model does to Mao's hole: one thing changed at a time, grains of 0.7 mm.

  bench/mao_study.py docs/validation

Reads what `livebed validate mao-study` has left in the folder (mao-study.json, mao-study-depth.csv, mao-study-profiles.csv)
and prints a row for each variant that has been run: means of S/D in windows of Mao's clock, its rms against Mao, Brier
skill of the bed, sand that passes 2 and 4 D behind the pipe beyond what the approach brings [D2/s of Mao's clock].
"""
import argparse
import collections
import json
import pathlib
import statistics

from mao_flux import MAO, PLACES, flux, read
from mao_sizes import DATA, rows

SCALE = (0.7 / 0.36) ** 1.5  # seconds of Mao's clock in one of the runs
WINDOWS = [(0.5, 1.5), (1.5, 2.5), (3.5, 4.5), (7, 9), (10, 12), (16.5, 19.5), (23.5, 25.5)]
SPANS = [(0, 11), (11, 25)]
FROM_JSON = ["rms of S/D over 1 to 12 s", "rms of S/D over 1 to 25 s", "Brier skill score of the bed at 11 s",
             "Brier skill score of the bed at 25 s"]


def means(points):
    """Of (t, S/D) in the windows; "-" where the record ends before."""
    cells = []
    for start, end in WINDOWS:
        inside = [S for t, S in points if start <= t <= end]
        cells.append(f"{statistics.mean(inside):.2f}" if inside and points[-1][0] > 0.98 * end else "-")
    return cells


def sand(lines):
    """Past 2 and 4 D in both spans of time; lines: {t: points}."""
    cells = []
    for start, end in SPANS:
        first, last = (min(lines, key=lambda t: abs(t - at)) for at in (start, end))
        if abs(last - end) > 1:
            cells.append("-")
            continue
        passed = flux(lines[first] if start else None, lines[last], last - (first if start else 0))
        cells.append(", ".join(f"{passed[PLACES.index(x)]:.3f}" for x in (2.0, 4.0)))
    return cells


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="with the files of `livebed validate mao-study`")
    folder = parser.parse_args().folder
    names = {}
    for line in (folder / "mao-study-depth.csv").read_text(encoding="utf-8").splitlines():
        if line.startswith("# variant "):
            number, says = line.removeprefix("# variant ").split(": ", 1)
            names[number] = says.rsplit("; commit", 1)[0]
    told = {row["name"]: row["value"] for row in json.loads((folder / "mao-study.json").read_text(encoding="utf-8"))}
    depth = collections.defaultdict(list)
    for row in rows(folder / "mao-study-depth.csv"):
        depth[row["variant"]].append((float(row["t_s"]) * SCALE, float(row["S_over_D"])))
    beds = collections.defaultdict(lambda: collections.defaultdict(list))
    for row in rows(folder / "mao-study-profiles.csv"):
        beds[row["variant"]][float(row["t_s"]) * SCALE].append((float(row["x_D"]), float(row["y_bed_D"])))

    head = ["one thing changed"] + [f"{a:g}-{b:g} s" for a, b in WINDOWS]
    head += ["rms 1-12 s", "1-25 s", "Brier skill 11 s", "25 s", "sand 0-11 s, 2 D, 4 D", "11-25 s"]
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for number in sorted(names, key=int):
        cells = means(depth[number])
        for what in FROM_JSON:
            found = [value for name, value in told.items() if name.startswith(f"mao-study, {names[number]}: ") and what in name]
            cells.append(f"{found[0]:.3f}" if found and "rms" in what else f"{found[0]:.2f}" if found else "-")
        print("| " + " | ".join([names[number]] + cells + sand(beds[number])) + " |")
    measured = [(float(r["t_s"]), float(r["S_over_D"])) for r in rows(DATA / "mao1986_livebed_depth.csv")]
    lines = {t: points for (_, t), points in read(MAO, 1).items()}
    print("| " + " | ".join(["Mao"] + means(measured) + ["", "", "", ""] + sand(lines)) + " |")


if __name__ == "__main__":
    main()
