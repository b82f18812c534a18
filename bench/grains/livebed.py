"""Livebed's side: moves grains with grain_run, the small program beside these scripts."""
import json
import os
import subprocess
import tempfile


def run(build, params, grains, stages, every=0):
    """grains: rows of d, x, y, u, v, omega; stages: (steps, drag) in turn.  Returns what grain_run prints."""
    job = dict(params=params, grains=grains, stages=[dict(steps=n, drag=b) for n, b in stages], every=every)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as f:
        json.dump(job, f)
        f.flush()
        text = subprocess.run([os.path.join(build, "grain_run"), f.name], check=True, stdout=subprocess.PIPE).stdout
    return json.loads(text)


def constants(build, params, grains):
    """Springs, dashpots, friction, step, gravity and inertial density that Livebed makes of the parameters."""
    return run(build, params, grains, [])
