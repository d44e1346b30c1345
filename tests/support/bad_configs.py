"""Configs with one wrong entry each, and what the refusal says."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parents[2]
DEFAULT = ROOT / "config" / "config.yaml"
MINIMAL = ROOT / "config" / "minimal.yaml"

Config = dict[str, Any]


class Bad(NamedTuple):
    """One wrong entry: where it stands (keys and indices by dots), what stands there, and what the error says."""

    at: str
    value: Any
    says: str
    schema: bool = True  # whether a JSON schema can refuse it too


MISSING = object()
RUBBER, ROAD = "rubbers.zhou2019", "roads.zhou2019"
NAN, INFINITE = float("nan"), float("inf")

UNKNOWN_KEYS = [
    Bad("grids", 1, r"config has the unknown key 'grids'; allowed are results, .* \(did you mean grid\?\)"),
    Bad("colour", "red", r"config has the unknown key 'colour'; allowed are results, rubber, .*, roads$"),
    Bad("grid.velocity", [1], r"grid has the unknown key 'velocity'; .* \(did you mean velocities\?\)"),
    Bad("aspect_study.aspect", [1], r"aspect_study has the unknown key 'aspect'; .* \(did you mean aspects\?\)"),
    Bad("figures.presure", 5, r"figures has the unknown key 'presure'; allowed are total_pressure, temperature, f"),
    Bad("figures.fields.scales", 1, r"figures.fields has the unknown key 'scales'; .* \(did you mean scale\?\)"),
    Bad("numerics.column_min", 8, r"numerics has the unknown key 'column_min'; .* \(did you mean columns_min\?\)"),
    Bad(f"{RUBBER}.bulk_fractions", [0.1], r"unknown key 'bulk_fractions'; .* \(did you mean bulk\?\)"),
    Bad("presets.draft.columns", 8, r"presets.draft has the unknown key 'columns'; .* \(did you mean columns_min\?\)"),
    Bad("presets.draft.columns_max", 512, r"presets.draft has the unknown key 'columns_max'; allowed are accuracy, "),
    Bad(f"{RUBBER}.bulks", 1, r"rubbers.zhou2019 has the unknown key 'bulks'; .* \(did you mean bulk\?\)"),
    Bad(f"{ROAD}.0.amplitud", 1, r"roads.zhou2019\[0\] has the unknown key .* \(did you mean amplitude\?\)"),
]
MISSING_KEYS = [
    Bad("plane", MISSING, "config lacks the key 'plane'"),
    Bad("multiscale", MISSING, "config lacks the key 'multiscale'"),
    Bad("kinematics", MISSING, "config lacks the key 'kinematics'"),
    Bad("numerics.preset", MISSING, "numerics lacks the key 'preset'"),
    Bad("presets", MISSING, "config lacks the key 'presets'"),
    Bad("presets.standard.accuracy", MISSING, "presets.standard lacks the key 'accuracy'"),
    Bad("grid.aspect", MISSING, "grid lacks the key 'aspect'"),
    Bad("aspect_study.aspects", MISSING, "aspect_study lacks the key 'aspects'"),
    Bad("claims.readings", MISSING, "claims lacks the key 'readings'"),
    Bad("numerics.tolerance", MISSING, "numerics lacks the key 'tolerance'"),
    Bad(f"{RUBBER}.relaxation_times", MISSING, "rubbers.zhou2019 lacks the key 'relaxation_times'"),
    Bad(f"{ROAD}.3.wavenumber", MISSING, r"roads.zhou2019\[3\] lacks the key 'wavenumber' .2 pi / wavelength, rad/mm"),
    Bad(f"{ROAD}.3.wavelength", 0.02, r"roads.zhou2019\[3\] has both wavenumber and wavelength, but must have one"),
]
WRONG_KINDS = [
    Bad(
        "grid.velocities.0",
        "1e-3",
        r"grid.velocities\[0\] is the text '1e-3', but must be a number \(YAML reads it as text; write 1.0e-3\)",
    ),
    Bad(f"{RUBBER}.density", "11e-10", r"rubbers.zhou2019.density is the text '11e-10', .* write 1.1e-9\)"),
    Bad("grid.pressures.1", "low", r"grid.pressures\[1\] is the text 'low', but must be a number$"),
    Bad("grid.aspect", True, "grid.aspect is True, but must be a number"),
    Bad("grid.pressures.0", False, r"grid.pressures\[0\] is False, but must be a number"),
    Bad("grid.aspect", [0.75], r"grid.aspect is \[0.75\], but must be a number"),
    Bad("grid.aspect", None, "grid.aspect is None, but must be a number"),
    Bad("grid.velocities", 100, "grid.velocities is 100, but must be a list of numbers"),
    Bad("grid.velocities", {"from": 1}, "grid.velocities is {'from': 1}, but must be a list of numbers"),
    Bad(f"{RUBBER}.shear_fractions", 0.5, "rubbers.zhou2019.shear_fractions is 0.5, but must be a list of numbers"),
    Bad("grid", [1, 10], r"grid is \[1, 10\], but must hold the keys velocities, pressures, aspect"),
    Bad("figures.fields", None, "figures.fields is None, but must hold the keys scale, velocities, pressures"),
    Bad(RUBBER, 4.17, "rubbers.zhou2019 is 4.17, but must hold the keys youngs_modulus, "),
    Bad(ROAD, {"amplitude": 1}, r"roads.zhou2019 is {'amplitude': 1}, but must be a list of at least one scale"),
    Bad(f"{ROAD}.1", 0.006, r"roads.zhou2019\[1\] is 0.006, but must hold the keys amplitude, wavenumber"),
    Bad("numerics", "standard", r"numerics is 'standard', but must hold the keys preset, "),
    Bad("presets", [], r"presets is \[\], but must hold at least one entry by name"),
    Bad("presets", {}, r"presets is {}, but must hold at least one entry by name"),
    Bad("presets.draft", 0.05, "presets.draft is 0.05, but must hold the keys accuracy, contact_nodes, "),
    Bad("rubbers", [], r"rubbers is \[\], but must hold at least one entry by name"),
    Bad("results", 5, "results is 5, but must be the path of a folder"),
    Bad("results", "", "results is '', but must be the path of a folder"),
    Bad("results", " ", "results is ' ', but must be the path of a folder", schema=False),
]
OUT_OF_RANGE = [
    Bad("grid.velocities.2", -1, r"grid.velocities\[2\] is -1 mm/s, but must be greater than 0"),
    Bad("grid.velocities.0", 0, r"grid.velocities\[0\] is 0 mm/s, but must be greater than 0"),
    Bad("grid.pressures.0", -0.5, r"grid.pressures\[0\] is -0.5 MPa, but must be greater than 0"),
    Bad("grid.aspect", 0, "grid.aspect is 0, but must be greater than 0"),
    Bad("aspect_study.aspects.0", -0.25, r"aspect_study.aspects\[0\] is -0.25, but must be greater than 0"),
    Bad("transient.scale", 5, "transient.scale is 5, but must be one of the road's scales, 1 to 4", schema=False),
    Bad("transient.velocities", [], "transient.velocities is empty, but must hold at least one number"),
    Bad("transient.pressure", 0, "transient.pressure is 0 MPa, but must be greater than 0"),
    Bad("transient.start", "press", r"transient.start is 'press', .* \(did you mean pressed\?\)"),
    Bad("transient.columns", 20, "transient.columns is 20, but must be a multiple of 8"),
    Bad("transient.steps_per_wavelength", 3, "steps_per_wavelength is 3, but must be a whole number of at least 4"),
    Bad("transient.wavelengths", 10**6, "transient.wavelengths is 1e\\+06, but must be at most 156250", schema=False),
    Bad("transient.wavelengths", 0, "transient.wavelengths is 0, but must be a whole number of at least 1"),
    Bad("transient.saturation", 0, "transient.saturation is 0, but must be at least 1e-06"),
    Bad("transient.saturation", 1, "transient.saturation is 1, but must be at most 0.5"),
    Bad("rig.virtual.sampling", 10, "rig.virtual.sampling is 10 Hz, but must be at least 100"),
    Bad("rig.virtual.area", 0, "rig.virtual.area is 0 mm², but must be greater than 0"),
    Bad("rig.virtual.force_noise", -1, "rig.virtual.force_noise is -1 N, but must be at least 0"),
    Bad("rig.virtual.traction", "sled", "rig.virtual.traction is 'sled', but must be one of rubber, rope"),
    Bad("rig.virtual.seed", 0.5, "rig.virtual.seed is 0.5, but must be a whole number of at least 0"),
    Bad("rig.pressures", [], "rig.pressures is empty, but must hold at least one number"),
    Bad("rig.data", "run.csv", "rig.data is 'run.csv', but must be a list of files"),
    Bad("rig.data", ["a.csv", "a.csv"], r"rig.data\[1\] is 'a.csv', the same as rig.data\[0\]; keep one"),
    Bad("rig.columns", 5, "rig.columns is 5, but must be the path of a file"),
    Bad("grid.velocities.0", NAN, r"grid.velocities\[0\] is nan, but must be a finite number", schema=False),
    Bad("grid.pressures.0", INFINITE, r"grid.pressures\[0\] is inf, but must be a finite number", schema=False),
    Bad("figures.total_pressure", NAN, "figures.total_pressure is nan, but must be a finite number", schema=False),
    Bad("grid.velocities", [], "grid.velocities is empty, but must hold at least one number"),
    Bad("aspect_study.scales", [], "aspect_study.scales is empty, but must hold at least one number"),
    Bad(
        "grid.velocities",
        [1, 0.1, 0.10],
        r"grid.velocities\[2\] is 0.1 mm/s, the same as grid.velocities\[1\]; keep one",
    ),
    Bad("grid.pressures", [0.3, 0.1 + 0.2], r"\[1\] is 0.3 MPa, the same as grid.pressures\[0\]", schema=False),
    Bad("aspect_study.scales", [1, 1.0], r"aspect_study.scales\[1\] is 1, the same as"),
    Bad("aspect_study.scales", [5], "is 5, but must be one of the road's scales, 1 to 4", schema=False),
    Bad("aspect_study.scales", [1.5], r"aspect_study.scales\[0\] is 1.5, but must be a whole number of at least 1"),
    Bad("figures.fields.scale", 9, "figures.fields.scale is 9, .* the road's scales, 1 to 4", schema=False),
    Bad("figures.fields.scale", 0, "figures.fields.scale is 0, but must be a whole number of at least 1"),
    Bad("figures.total_pressure", 3, "figures.total_pressure has 3, .* chosen from grid.pressures: 0.1, ", False),
    Bad("figures.fields.velocities", [2], "has 2, but must be chosen from grid.velocities: 0.1, 1, 10, ", False),
    Bad("figures.fields.pressures", [9], "has 9, but must be chosen from grid.pressures: 0.1, 0.2, ", False),
    Bad("numerics.contact_nodes", 3, "numerics.contact_nodes is 3, but must be a whole number of at least 4"),
    Bad("numerics.contact_nodes", 6.5, "numerics.contact_nodes is 6.5, but must be a whole number"),
    Bad("numerics.accuracy", 0, "numerics.accuracy is 0, but must be at least 1e-06"),
    Bad("numerics.accuracy", 0.6, "numerics.accuracy is 0.6, but must be at most 0.5"),
    Bad("numerics.finite_contact_nodes", 3, "numerics.finite_contact_nodes is 3, but must be a whole number of at lea"),
    Bad("numerics.finite_columns_min", 100, "numerics.finite_columns_min is 100, but must be a multiple of 8"),
    Bad("numerics.columns_max", 1001, "numerics.columns_max is 1001, but must be a multiple of 8"),
    Bad("numerics.output_columns", 0, "numerics.output_columns is 0, but must be a whole number of at least 1"),
    Bad(
        "numerics.columns_max",
        120,
        "numerics.columns_max is 120, but must be a whole number of at least 128",
        schema=False,
    ),
    Bad("numerics.row_growth", 1, "numerics.row_growth is 1, but must be at least 1.00001"),
    Bad("numerics.refinements", -1, "numerics.refinements is -1, but must be a whole number of at least 0"),
    Bad("numerics.folding", -0.1, "numerics.folding is -0.1, but must be at least 0"),
    Bad("numerics.tolerance", 0.1, "numerics.tolerance is 0.1, but must be at most 0.01"),
    Bad("numerics.first_row", 101, "numerics.first_row is 101, but must be at most 100"),
    Bad("presets.draft.accuracy", 0, "presets.draft.accuracy is 0, but must be at least 1e-06"),
    Bad("presets.reference.accuracy", "1e-3", r"presets.reference.accuracy is the text '1e-3', .* write 1.0e-3\)"),
    Bad("presets.reference.contact_nodes", 3, "presets.reference.contact_nodes is 3, but must be a whole number"),
]
BAD_MODELS = [
    Bad("numerics.preset", "standart", r"numerics.preset is 'standart', .* .did you mean standard\?.", schema=False),
    Bad("numerics.preset", 5, "numerics.preset is 5, but must be one of draft, standard, reference$"),
    Bad("numerics.dilatation", "meen", r"numerics.dilatation is 'meen', .* auto, pointwise, mean .did you mean mean"),
    Bad("presets.a b", {}, "name in presets is 'a b', but must be a word of letters, digits, '-' and '_'"),
    Bad("plane", "stresses", r"plane is 'stresses', but must be one of stress, strain \(did you mean stress\?\)"),
    Bad(
        "multiscale",
        "sums",
        r"multiscale is 'sums', but must be one of sum, corrected, cascade, persson, direct, auto .did you me",
    ),
    Bad(
        "multiscale_preset", "fast", "multiscale_preset is 'fast', but must be one of draft, standard, reference", False
    ),
    Bad("phases.draws", -1, "phases.draws is -1, but must be a whole number of at least 0"),
    Bad("phases.seed", 0.5, "phases.seed is 0.5, but must be a whole number of at least 0"),
    Bad(
        f"{ROAD}.1.wavenumber",
        81.1234567,
        r"roads.zhou2019 cannot be taken whole, as multiscale: auto does: .* 35, 81.0\d*, 199.\S*, 300.\S* 1/mm, "
        "which .*; multiscale: sum does without$",
        schema=False,
    ),
    Bad("kinematics", "larg", r"kinematics is 'larg', but must be one of small, finite, auto"),
    Bad("rubber", "zhou", r"rubber is 'zhou', but must be one of zhou2019 \(did you mean zhou2019\?\)", schema=False),
    Bad("road", "gravel", "road is 'gravel', but must be one of zhou2019$", schema=False),
    Bad("rubber", ["zhou2019", "zhou"], r"rubber\[1\] is 'zhou', but must be .* \(did you mean zhou2", schema=False),
    Bad("multiscale_preset", [], r"multiscale_preset is \[\], but must be one of draft, standard, reference"),
    Bad("rubber", [], "rubber is empty, but must hold at least one name"),
    Bad("road", ["zhou2019", "zhou2019"], r"road\[1\] is 'zhou2019', the same as road\[0\]; keep one"),
    Bad("road", ["zhou2019", 5], r"road\[1\] is 5, but must be a word of letters"),
    Bad("rubber", {"zhou2019": 1}, r"rubber is \{'zhou2019': 1\}, but must be one of zhou2019"),
    Bad("rubbers.a/b", {}, "name in rubbers is 'a/b', but must be a word of letters, digits, '-' and '_'"),
    Bad("roads.a b", [], "name in roads is 'a b', but must be a word"),
    Bad("roads.gummi_weiß", [{"amplitude": 1, "wavenumber": 1}], "name in roads is 'gummi_weiß', but must be a word"),
    Bad(f"{RUBBER}.youngs_modulus", 0, "rubbers.zhou2019.youngs_modulus is 0 MPa, but must be greater than 0"),
    Bad(f"{RUBBER}.poissons_ratio", 0.5, "poissons_ratio is 0.5, but must lie between -1 and 0.5, both excluded"),
    Bad(f"{RUBBER}.poissons_ratio", -1, "poissons_ratio is -1, but must lie between -1 and 0.5"),
    Bad(
        f"{RUBBER}.shear_fractions.3",
        0.2,
        r"shear_fractions add up to 1\.0\d*, but must stay below 1",
        schema=False,
    ),
    Bad(f"{RUBBER}.shear_fractions.0", -0.1, r"rubbers.zhou2019.shear_fractions\[0\] is -0.1, but must be greater"),
    Bad(
        f"{RUBBER}.shear_fractions",
        [0.1, 0.2],
        "rubbers.zhou2019.relaxation_times has 6 numbers, but must have as many as shear_fractions, 2",
        schema=False,
    ),
    Bad(f"{RUBBER}.relaxation_times.5", 0, r"relaxation_times\[5\] is 0 s, but must be greater than 0"),
    Bad(f"{RUBBER}.moduli", "longterm", "moduli is 'longterm', .* long_term, instantaneous .did you mean long_term"),
    Bad(f"{RUBBER}.bulk", "rigid", "bulk is 'rigid', but must be one of elastic, proportional"),
    Bad(f"{RUBBER}.density", 0, "rubbers.zhou2019.density is 0 t/mm³, but must be greater than 0"),
    Bad(ROAD, [], r"roads.zhou2019 is \[\], but must be a list of at least one scale"),
    Bad(f"{ROAD}.2.wavenumber", 0, r"roads.zhou2019\[2\].wavenumber is 0 1/mm, but must be greater than 0"),
    Bad(f"{ROAD}.2.amplitude", -0.003, r"roads.zhou2019\[2\].amplitude is -0.003 mm, but must be at least 0"),
]
CLAIMS = [
    Bad("grid.refine", 1, "grid.refine is 1, but must be at most 0.2"),
    Bad("grid.refine", 0, "grid.refine is 0, but must be at least 0.001"),
    Bad(
        *("grid", {"velocities": [1], "pressures": [1], "aspect": 0.75, "refine": 0.01}),
        "grid.refine is 0.01, but grid.velocities has one speed: give two at least",
        schema=False,
    ),
    Bad("claims.difference", 0, "claims.difference is 0, but must be at least 0.001"),
    Bad("claims.difference", 0.6, "claims.difference is 0.6, but must be at most 0.5"),
    Bad("claims.preset", "rough", "claims.preset is 'rough', but must be one of draft, standard, reference", False),
    Bad("claims.readings", [], r"claims.readings is \[\], but must hold entries by name, or {} for none"),
    Bad("claims.readings.campaign", {}, "claims.readings has 'campaign', which names the campaign itself", False),
    Bad("claims.readings.a b", {}, "name in claims.readings is 'a b', but must be a word"),
    Bad("claims.readings.plane_strain.plane", "flat", "claims.readings.plane_strain.plane is 'flat', but must be one"),
    Bad("claims.readings.plane_strain.plane", None, "claims.readings.plane_strain.plane is None, but must be one"),
    Bad("claims.readings.plane_strain.pressure", 1, "claims.readings.plane_strain has the unknown key 'pressure'"),
    Bad("claims.compare", "strain", "claims.compare is 'strain', but must be a list of names"),
    Bad("claims.compare", ["stress"], r"claims.compare is 'stress', but must be one of plane_strain, ", False),
    Bad("claims.compare", ["plane_strain"] * 2, r"claims.compare\[1\] is 'plane_strain', the same as claims.compare"),
]
BAD_CONFIGS = [*CLAIMS, *UNKNOWN_KEYS, *MISSING_KEYS, *WRONG_KINDS, *OUT_OF_RANGE, *BAD_MODELS]


def case_name(case: Any) -> str:
    return f"{case.at}={'missing' if case.value is MISSING else case.value}"


def changed(config: Config, at: str, value: Any) -> Config:
    """Return a copy of a config with another entry at a place such as ``roads.zhou2019.0.amplitude``."""
    result = copy.deepcopy(config)
    *way, last = (int(key) if key.isdigit() else key for key in at.split("."))
    place: Any = result
    for key in way:
        place = place[key]
    if value is MISSING:
        del place[last]
    else:
        place[last] = value
    return result
