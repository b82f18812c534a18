"""Runs OpenFOAM from Debian's package."""
import os
import shutil
import subprocess
import sys

import setup

DEBIAN = "/usr/share/openfoam"  # the package sets no environment


def environment():
    if shutil.which("pimpleFoam") is None:
        sys.exit("pimpleFoam is not installed: apt-get install openfoam")
    return {"WM_PROJECT_DIR": DEBIAN, **os.environ}


def call(case, *command):
    """Runs a tool in the case, its output into log.NAME; stops with the log's end when it fails."""
    path = os.path.join(case, "log." + os.path.basename(command[0]))
    with open(path, "w") as log:
        code = subprocess.run(command, cwd=case, stdout=log, stderr=subprocess.STDOUT, env=environment()).returncode
    if code != 0:
        sys.exit(f"{' '.join(command)} failed in {case}:\n" + "".join(open(path).readlines()[-20:]))


def make_mesh(case):
    """Mesh and start fields of a case written by setup."""
    shutil.copytree(f"{case}/0.orig", f"{case}/0", dirs_exist_ok=True)
    call(case, "blockMesh")
    if os.path.exists(f"{case}/system/topoSetDict"):
        call(case, "topoSet")
        call(case, "subsetMesh", "-overwrite", "fluid", "-patch", "pipe")


def map_from(case, source):
    """Starts the case from the last fields of another one on another mesh."""
    call(case, "mapFields", os.path.abspath(source), "-sourceTime", "latestTime", "-consistent")
    for name in os.listdir(f"{case}/0"):
        if name not in ("U", "p", "k", "epsilon", "nut"):  # means would be continued
            path = f"{case}/0/{name}"
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def run_fitted(case, level, end, start, source=None, reynolds=9500.0, at_pipe=setup.FIRST, **options):
    """Body-fitted run with means from `start` on, unless its folder says that it is done."""
    if os.path.exists(f"{case}/done"):
        return
    shutil.rmtree(case, ignore_errors=True)
    setup.use_reynolds(reynolds)
    setup.fitted_mesh(case, level, at_pipe)
    # The O-grid's corners need a non-orthogonal correction and a third corrector.
    setup.write_openfoam(case, correctors=3, non_orthogonal=1, end=end, average_from=start, **options)
    make_mesh(case)
    if source:
        map_from(case, source)
    call(case, "pimpleFoam")
    for function in ("writeCellCentres", "grad(UMean)", "profiles"):
        call(case, "postProcess", "-func", function, "-latestTime")
    open(f"{case}/done", "w").close()
