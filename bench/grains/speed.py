#!/usr/bin/env python3
"""Grain steps a second of LAMMPS, LIGGGHTS and Livebed on the same settled bed, in turns.

  speed.py BUILD OUT [--rounds N] [--only GRAINS]... [--cores N]...

`livebed bench grains --bed` makes the bed (5 % size spread) and times itself on it; the others read its grains and
constants.  All grains are awake, friction, history and dashpots are on, lists are made anew every 100 steps.  What
counts is each code's own time for its steps, without start and warm-up (which gives the contacts their history back).
Each line of the table: median (smallest to largest) over the rounds, contacts a grain at the end, and the largest
number of cores that other programs kept busy in the meantime: above 0.1 the line says little.  OUT keeps the beds; a
version of Livebed that packs another bed wants another OUT.
"""
import argparse
import json
import os
import re
import resource
import statistics
import subprocess
import sys
import time

import peers

# grains: steps of warm-up and of the timed stretch of LAMMPS and LIGGGHTS
SIZES = {6240: (1000, 10000), 199680: (100, 400)}
REBUILD = 100  # steps; `livebed bench grains` does the same
CODES = ("LAMMPS", "LIGGGHTS", "Livebed", "Livebed, mixed")  # the last: grains.precision = mixed


def bench(build, grains, cores, *more):
    command = [os.path.join(build, "livebed"), "--threads", str(cores), "bench", "grains", "--json", "--grains",
               str(grains), *more]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def prepare(build, out, grains):
    """Folder with the bed's data files; returns the bed's constants."""
    folder = f"{out}/{grains}"
    if not os.path.exists(f"{folder}/bed.json"):
        os.makedirs(folder, exist_ok=True)
        bench(build, grains, 1, "--bed", f"{folder}/bed.json")
    with open(f"{folder}/bed.json") as f:
        bed = json.load(f)
    rows = bed.pop("grains")
    height = 1.5 * max(r[2] for r in rows)
    for code, density, types in (("lammps", peers.sphere_density, 1), ("liggghts", peers.disk_density, 2)):
        os.makedirs(f"{folder}/{code}", exist_ok=True)
        if not os.path.exists(f"{folder}/{code}/in.data"):
            peers.write_data(f"{folder}/{code}/in.data", rows, density(bed), bed["length"], height, types)
    return bed


def time_peer(code, out, told, grains, cores):
    warm, steps = SIZES[grains]
    end = "\n".join(["compute touching all contact/atom", "compute contacts all reduce ave c_touching",
                     f"neigh_modify every {REBUILD} delay 0 check no", f"run {warm}", f"run {steps}",
                     "thermo_style custom step c_contacts", "run 0"])
    skin = 0.2 * told["diameter"]
    lammps = code == "LAMMPS"
    deck = peers.lammps_deck(told, skin, end=end) if lammps else peers.liggghts_deck(told, skin, end=end, dimension=2)
    folder = f"{out}/{grains}/{code.lower()}"
    text = peers.call(folder, "lmp" if lammps else "liggghts", deck, cores)
    loops = re.findall(r"Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms", text)
    seconds, procs, done, atoms = next(loop for loop in loops if int(loop[2]) == steps)
    if int(procs) != cores:
        sys.exit(f"{code} ran on {procs} cores instead of {cores}")
    contacts = float(re.findall(r"^\s*\d+\s+(\S+)\s*$", text, re.MULTILINE)[-1])
    return dict(rate=int(atoms) * int(done) / float(seconds), contacts=contacts)


def time_livebed(build, grains, cores, *more):
    told = bench(build, grains, cores, *more)
    return dict(rate=told["grain_steps_per_second"], contacts=told["contacts_per_grain"], commit=told["commit"])


def busy():
    """Processor seconds of the machine, and of the processes that have ended below this one."""
    with open("/proc/stat") as f:
        user, nice, system, _, _, irq, softirq = [int(w) for w in f.readline().split()[1:8]]
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("out")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", type=int, action="append", choices=SIZES)
    parser.add_argument("--cores", type=int, action="append")
    a = parser.parse_args()
    print("| grains | cores | code | million grain-steps a second | Livebed faster | contacts a grain | others, cores |\n|"
          + "---|" * 7)
    commit = ""
    for grains in a.only or SIZES:
        told = prepare(a.build, a.out, grains)
        for cores in a.cores or (1, 2):
            runs = {code: [] for code in CODES}
            for turn in range(a.rounds):
                for code in CODES:
                    if code.startswith("Livebed"):
                        more = ("--mixed",) if code.endswith("mixed") else ()
                        runs[code].append(watched(time_livebed, a.build, grains, cores, *more))
                    else:
                        runs[code].append(watched(time_peer, code, a.out, told, grains, cores))
                    print(f"{grains} grains, {cores} cores, round {turn + 1}, {code}: {runs[code][-1]}", file=sys.stderr)
            commit = runs["Livebed"][0]["commit"]
            ours = statistics.median(r["rate"] for r in runs["Livebed"])
            for code in CODES:
                rates = [1e-6 * r["rate"] for r in runs[code]]
                faster = "" if code.startswith("Livebed") else f"{1e-6 * ours / statistics.median(rates):.1f}"
                print(f"| {grains} | {cores} | {code} | {statistics.median(rates):.2f} ({min(rates):.2f} to"
                      f" {max(rates):.2f}) | {faster} | {runs[code][-1]['contacts']:.2f} |"
                      f" {max(r['others'] for r in runs[code]):.2f} |", flush=True)
    print(f"\nLivebed of commit {commit}.")


if __name__ == "__main__":
    main()
