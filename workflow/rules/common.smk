# What all rules share: paths, the names of rubber and road, and how a job runs.
import hashlib
from dataclasses import asdict

import rubfric
from rubfric import jobs
from rubfric.campaign import load
from rubfric.checks import written
from rubfric.readings import AS_CONFIGURED
from rubfric.sources import sources
from rubfric.trials import batches, drawn_scenes, fixed_scenes

RESULTS = CAMPAIGN.results
RUBBER = CAMPAIGN.material.name
ROAD = CAMPAIGN.road_name


wildcard_constraints:
    scene=r"scale\d+_v[0-9.e-]+_p[0-9.e-]+_aspect[0-9.e-]+_(stress|strain)",
    scale=r"\d+",
    figure=r"\w+",


def package_files(*modules):
    """Return the package's files behind some modules: a job that lists them reruns when their content changes."""
    return [os.path.relpath(path) for path in sources(*modules)]


def scene_file(name):
    """Return where the result of a scene belongs."""
    return f"{RESULTS}/scenes/{RUBBER}/{ROAD}/{name}.nc"


def march_file(name):
    """Return where the march of a scene belongs."""
    return f"{RESULTS}/marches/{RUBBER}/{ROAD}/{name}.nc"


def fingerprint(words):
    """Return a short name for a list of words."""
    return hashlib.sha256(" ".join(words).encode()).hexdigest()[:16]


def reading_file(reading, batch):
    """Return where observations of a batch of scenes in another reading of the paper belong."""
    return f"{RESULTS}/readings/{reading}/{RUBBER}/{ROAD}/{batch}.csv"


def batches_by_speed(scenes):
    """Return scenes by name, in batches of one scale and speed."""
    batches = {}
    for name, scene in scenes.items():
        batch = f"scale{scene.scale}_v{written(scene.velocity)}"
        batches.setdefault(batch, {})[name] = scene
    return batches


def judged_by(campaign):
    """Return what the verdicts on the paper's claims depend on, besides results."""
    fields = campaign.figures
    return {
        "aspect": campaign.aspect,
        "studied": list(campaign.aspect_study.pressures),
        "profiled": {
            "scale": [fields.scale],
            "velocity": list(fields.velocities),
            "pressure": list(fields.pressures),
            "aspect": [campaign.aspect],
        },
        "difference": campaign.claims.difference,
        "saturation": campaign.transient.saturation,
        "total_pressure": fields.total_pressure,
    }
