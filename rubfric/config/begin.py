"""A config to begin with: every key that an own campaign needs, with its unit."""

from __future__ import annotations

import os
from pathlib import Path

from rubfric.errors import InvalidInput

BEGINNING = """\
# A campaign of your own:   snakemake -j2 --configfile {file}      (with -n: what would run, and how long it takes)
#
# It runs this grid only. What the paper's campaign adds runs where it is named here: aspect_study, transient, rig and
# claims.
# All keys, with units, bounds and defaults: config/README.md. Write powers of ten as 1.0e-3: YAML reads 1e-3 as text.

# Folder of all outputs.
results: results/{name}

rubber: {name}
rubbers:
  {name}:
    youngs_modulus: 3.0                          # MPa (N/mm²), at rest; with moduli: instantaneous that of the glass
    moduli: long_term
    poissons_ratio: 0.49
    shear_fractions: [0.2, 0.3, 0.45]            # g_i, shares of the instantaneous modulus; sum below 1
    relaxation_times: [1.0e-3, 1.0e-5, 1.0e-7]   # tau_i, s
    bulk: elastic                                # k_i = 0; or proportional, k_i = g_i
    density: 1.1e-9                              # t/mm³, 1.1 g/cm³
    # In place of all these, moduli that were measured (docs/rubber.md):   measurements: dma.csv

road: {name}
roads:
  {name}:                                        # sine scales, from coarse to fine
    - {{amplitude: 0.01, wavelength: 0.18}}        # mm; or wavenumber: 2 pi / wavelength, rad/mm (here 34.9)
    - {{amplitude: 0.002, wavelength: 0.03}}
    # In place of this list, a profile that was measured (docs/road.md):   {name}: {{profile: street.csv}}

grid:
  velocities: [1, 10, 100, 1000]                 # mm/s
  pressures: [0.2, 1]                            # MPa, nominal
  aspect: 0.75                                   # height of the block over its width, one wavelength

plane: stress                                    # or strain
kinematics: auto                                 # or small, finite
multiscale: auto                                 # the whole road: auto, or sum, corrected, cascade, persson, direct
numerics: {{preset: standard}}                     # friction to 1 %; draft: 5 %, reference: 0.2 %
"""


def begin(path: str | os.PathLike[str]) -> None:
    """Write a config to begin with, named for the file.

    Raises
    ------
    InvalidInput
        Where there is such a file already, which is left alone, the name is no name of a YAML file, or nothing can be
        written there.
    """
    place = Path(path)
    name = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in place.stem)
    if place.suffix not in (".yaml", ".yml"):
        raise InvalidInput(f"{os.fspath(path)} would be a config, but must have a name that ends in .yaml")
    try:
        with place.open("x", encoding="utf-8") as stream:
            stream.write(BEGINNING.format(file=os.fspath(path), name=name[:40] or "mine"))
    except FileExistsError:
        raise InvalidInput(f"{os.fspath(path)} exists, and is left as it is: give another name") from None
    except OSError as error:
        reason = "there is no such folder" if isinstance(error, FileNotFoundError) else error.strerror
        raise InvalidInput(f"{os.fspath(path)} cannot be written: {reason}") from error
