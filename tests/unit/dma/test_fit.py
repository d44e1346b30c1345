"""Fitted rubbers against those that were measured."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from synthetic_dma import Truth, drawn, measurements, table_1

from rubfric.dma.bootstrap import bootstrap
from rubfric.dma.entry import as_shear, rubber, shifted
from rubfric.dma.fit import fit
from rubfric.dma.joint import refine
from rubfric.dma.laws import law_of
from rubfric.dma.measurements import Measurements, ordered, read
from rubfric.dma.result import Options
from rubfric.dma.search import search
from rubfric.dma.spectrum import kernel
from rubfric.errors import InvalidInput

# Files of others, which are not shipped: beside the project, or where the variable says.
# Files of other laboratories, which are not part of the project: a folder that the environment names.
MEASURED = Path(os.environ.get("RUBFRIC_MEASURED", "nowhere")) / "dma"
TEMPERATURES = np.array([-45.0, -35.0, -25.0, -15.0, -5.0, 5.0, 20.0])
HERTZ = np.geomspace(0.1, 100.0, 13)


def misses(truth: Truth, data: Measurements, residuals: tuple[np.ndarray, np.ndarray]) -> float:
    """Return the rms by which a fit misses the true moduli at the points measured, the larger of the two."""
    true = truth.at(data.temperatures[data.isotherm], data.frequency)
    pairs = zip((data.storage, data.loss), residuals, true, strict=True)
    return max(float(np.sqrt(np.mean((own * (1.0 - part) / each - 1.0) ** 2))) for own, part, each in pairs)


def test_table_1_comes_back_from_its_own_measurements(rng: np.random.Generator) -> None:
    truth = table_1()
    found = fit(measurements(truth, TEMPERATURES, HERTZ, 0.01, rng))
    assert found.law == "wlf"
    assert found.warnings == ()
    assert len(found.times) == 6
    assert found.times == pytest.approx(np.sort(truth.times), rel=0.03)
    assert found.moduli == pytest.approx(truth.moduli[np.argsort(truth.times)], rel=0.03)
    assert found.static == pytest.approx(4.17, rel=0.01)
    material = rubber(found, "mine")
    assert material.youngs_modulus == pytest.approx(4.17, rel=0.01)
    assert (material.moduli, material.bulk) == ("long_term", "proportional")
    frequency = np.geomspace(1.0, 1e9, 20)
    young = 2.0 * (1.0 + 0.49) * material.complex_shear_modulus(frequency)
    assert np.stack(found.moduli_at(frequency)) == pytest.approx(np.stack([young.real, young.imag]), rel=1e-5)
    # The rubber at another temperature is that which was measured there.
    cold = shifted(found, material).at(-25.0)
    storage, loss = truth.at(np.full(13, -25.0), 2.0 * np.pi * HERTZ)
    shear = cold.complex_shear_modulus(2.0 * np.pi * HERTZ)
    assert 2.98 * shear.real == pytest.approx(storage, rel=0.03)
    assert 2.98 * shear.imag == pytest.approx(loss, rel=0.03)


def test_the_example_gives_what_its_page_says() -> None:
    folder = Path(__file__).resolve().parents[3] / "examples/own_rubber"
    found = fit(read(str(folder / "dma.csv")))
    page = (folder / "README.md").read_text(encoding="utf-8")
    assert f"| C1 | {found.c1:.3g} |" in page
    assert f"| C2 (K) | {found.c2:.4g} |" in page
    assert f"| branches | {len(found.times)} |" in page


def covered(seeds: range, samples: int, arrhenius: bool = False) -> np.ndarray:
    """Return for each seed whether the law, both its constants and the master curve were found."""
    rows = []
    for seed in seeds:
        truth, data, noise = drawn(seed, arrhenius)
        found = fit(data, Options(20.0, samples=samples))
        bands = bootstrap(found)
        names = {"activation_energy": truth.energy} if arrhenius else {"c1": truth.c1, "c2": truth.c2}
        within = [low <= value <= high for name, value in names.items() for low, high in [bands.of(name)]]
        law = found.law == ("arrhenius" if arrhenius else "wlf")
        rows.append([law, *within, misses(truth, found.data, found.residuals) < noise])
    return np.array(rows)


def test_a_few_random_rubbers_are_found() -> None:
    assert covered(range(100, 102), 40)[:, [0, -1]].all()


@pytest.mark.thorough
def test_bands_cover_the_truth() -> None:
    # With 95 % each, 24 or more of 30 and 7 or more of 10 are found in 99.9 % of all such runs.
    assert (covered(range(12), 100).sum(axis=0) >= 9).all()
    assert (covered(range(4), 100, arrhenius=True).sum(axis=0) >= 3).all()


def test_free_shifts_where_a_law_fails(rng: np.random.Generator) -> None:
    # Below -20 degC a glass: shifts stay behind those of any law.
    truth = table_1()
    true = truth.log_factor(TEMPERATURES)
    glassy = np.where(TEMPERATURES < -20.0, true[2] + 0.25 * (true - true[2]), true)
    frequency, temperature = np.tile(2.0 * np.pi * HERTZ, 7), np.repeat(TEMPERATURES, 13)
    storage, loss = truth.at(np.full(91, 20.0), frequency * 10.0 ** np.repeat(glassy, 13))
    noise = 1.0 + 0.01 * rng.standard_normal((2, 91))
    data = ordered("glass.csv", "E", frequency, temperature, storage * noise[0], loss * noise[1])
    found = fit(data)
    assert found.law == "free"
    assert "the WLF equation fails" in found.warnings[0]
    assert "free shifts were taken" in found.warnings[-1]
    assert found.log_shifts == pytest.approx(glassy, abs=0.03)
    forced = fit(data, Options(law="wlf"))
    assert forced.law == "wlf"
    assert "as asked" in forced.warnings[0]


def test_vertical_shifts_are_found(rng: np.random.Generator) -> None:
    truth = table_1()
    data = measurements(truth, TEMPERATURES, HERTZ, 0.005, rng)
    scale = (data.temperatures + 273.15) / 293.15
    data = replace(data, storage=data.storage * scale[data.isotherm], loss=data.loss * scale[data.isotherm])
    found = fit(data, Options(vertical="entropic"))
    assert max(found.rms) < 0.006
    assert found.c1 == pytest.approx(truth.c1, rel=0.02)
    free = fit(data, Options(vertical="free", law="wlf"))
    assert 10.0**free.log_scales == pytest.approx(scale, rel=0.03)
    shift = free.shift()
    assert shift is not None
    assert shift.modulus_factor(-25.0) == pytest.approx(scale[2], rel=0.03)


def test_errors_of_the_temperature_are_no_failure_of_the_law(rng: np.random.Generator) -> None:
    # 0.5 K, which take the residuals far beyond the noise; two frequencies; and a cold isotherm out of reach.
    moduli = 10.0 ** (np.linspace(3.0, 0.0, 60) - 0.5 * np.sin(np.linspace(0.0, 5.0, 60)))
    truth = Truth(2.0, moduli, np.geomspace(1e-10, 1e2, 60))
    temperatures, hertz = np.arange(-30.0, 60.0, 6.0), np.geomspace(0.1, 100.0, 8)
    temperature, frequency = np.repeat(temperatures, 8), np.tile(2.0 * np.pi * hertz, 15)
    storage, loss = truth.at(temperature + np.repeat(rng.normal(0.0, 0.5, 15), 8), frequency)
    found = fit(ordered("dma.csv", "E", frequency, temperature, storage, loss))
    assert found.law == "wlf"
    assert found.c1 == pytest.approx(8.86, rel=0.05)
    assert max(found.rms) > 0.01
    two = fit(measurements(truth, np.arange(-40.0, 60.0, 5.0), np.array([1.0, 10.0]), 0.01, rng), Options(law="wlf"))
    assert "isotherms at -40 degC left out" in two.data.notes[-1]
    assert two.c1 == pytest.approx(8.86, rel=0.05)
    low, high = bootstrap(replace(found, options=replace(found.options, samples=20))).of("c1")
    assert low < 8.86 < high


def test_bad_points_are_left_out_and_named(rng: np.random.Generator) -> None:
    truth = table_1()
    data = measurements(truth, TEMPERATURES, HERTZ, 0.01, rng)
    loss = data.loss.copy()
    loss[40] *= 2.0
    loss[data.frequency > 600.0] *= 1.3
    found = fit(replace(data, loss=loss))
    assert len(found.data.storage) == len(loss) - 8
    assert "7 points at 100 Hz left out" in found.data.notes[0]
    assert "1 outliers left out" in found.data.notes[1]
    assert found.c1 == pytest.approx(truth.c1, rel=0.02)


def test_options(rng: np.random.Generator) -> None:
    truth = table_1()
    data = measurements(truth, TEMPERATURES, HERTZ, 0.01, rng)
    even = fit(data, Options(law="wlf", per_decade=2.0))
    low, high = even.window
    assert even.times.min() > 0.9 / high
    assert even.times.max() < 1.1 / low
    assert fit(data, Options(law="wlf", static=4.0)).static == 4.0
    # Of a rubber whose bulk modulus is constant, E* and G* are the same data.
    bulk = 3000.0
    found = fit(as_shear(data, bulk), Options(law="wlf"))
    material = rubber(found, "mine", bulk_modulus=bulk)
    assert material.long_term_bulk_modulus == pytest.approx(bulk, rel=1e-6)
    shear = material.complex_shear_modulus(2.0 * np.pi * HERTZ)
    storage, _ = truth.at(np.full(13, 20.0), 2.0 * np.pi * HERTZ)
    assert (9.0 * bulk * shear / (3.0 * bulk + shear)).real == pytest.approx(storage, rel=0.02)


def test_refusals(rng: np.random.Generator) -> None:
    truth = table_1()
    data = measurements(truth, TEMPERATURES, HERTZ, 0.01, rng)
    for told, options, words in (
        (measurements(truth, TEMPERATURES, HERTZ[:1], 0.01, rng), Options(), "one frequency"),
        (measurements(truth, TEMPERATURES[-2:], HERTZ, 0.01, rng), Options(), "has 2 temperatures"),
        (data, Options(reference_temperature=80.0), "must lie within those measured"),
        (measurements(truth, TEMPERATURES[:5], HERTZ, 0.01, rng), Options(), "say --reference-temperature"),
        (data, Options(static=1e4), "must be below the least storage modulus"),
        (measurements(truth, TEMPERATURES[[0, 3, 6]], HERTZ[:3], 0.0, rng), Options(law="free"), "do not overlap"),
        (measurements(truth, TEMPERATURES[[0, 3, 6]], HERTZ[:3], 0.0, rng), Options(law="wlf"), "bridges at most 1"),
        (measurements(truth, TEMPERATURES[-1:], HERTZ[:4], 0.01, rng), Options(), "has 4 usable points"),
    ):
        with pytest.raises(InvalidInput, match=words):
            fit(told, options)
    melt = replace(truth, static=1e-9)
    with pytest.raises(InvalidInput, match="give --static-modulus"):
        rubber(fit(measurements(melt, TEMPERATURES, HERTZ, 0.001, rng), Options(law="wlf")), "melt")
    with pytest.raises(InvalidInput, match="rubber has about 2000"):
        as_shear(data, 100.0)


@pytest.mark.skipif(not MEASURED.is_dir(), reason="RUBFRIC_MEASURED names no folder of measured files")
@pytest.mark.thorough
def test_stiff_polymer() -> None:
    data = read(str(MEASURED / "pyvisco_freq_user_raw.csv"))
    assert len(data.temperatures) == 21
    found = fit(data, Options(25.0, vertical="entropic", law="free"))
    assert max(found.rms) < 0.04
    assert "at 100 Hz left out" in found.data.notes[0]
    master = read(str(MEASURED / "pyvisco_freq_user_master.csv"), master=True)
    assert master.is_master
    assert len(master.storage) == 205


def test_derivatives_of_the_residuals(rng: np.random.Generator) -> None:
    # The bends of the fit: with the moduli held, residuals change with ln tau as the derivative says.
    data = measurements(table_1(), TEMPERATURES, HERTZ, 0.01, rng)
    joint = search(data, law_of("wlf", data.temperatures, 20.0), "none", 20.0, None)
    joint = refine(data, joint, 1.0, 0.5, None)
    step = 1e-6
    reduced = data.frequency * np.exp(joint.shifts[data.isotherm])
    fitted = [np.concatenate(kernel(reduced, joint.times * np.exp(sign * step))) for sign in (-1.0, 1.0)]
    over = np.concatenate((1.0 / data.storage, 1.0 / data.loss))
    numerical = -(fitted[1] - fitted[0]) / (2.0 * step) * over[:, None] * joint.spectrum.moduli[1:]
    assert joint.spectrum.by_time == pytest.approx(numerical, abs=1e-6)
