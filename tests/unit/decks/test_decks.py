"""Rubbers through the decks of three codes, and decks that hold what the model does not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rubfric.decks.deck import rubber
from rubfric.decks.files import CODES, read_deck, write_deck
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber

FREQUENCY = np.geomspace(1.0, 1e12, 40)
ABAQUS = """\
*Heading
*Material, name=Tread
*Density
 1.2e-9,
*Hyperelastic, mooney-rivlin, moduli={moduli}
 0.3, 0.1, 0.02
*Viscoelastic, time=PRONY
 0.2, 0.0, 1.e-3
 0.1,, 1.0D-3
 0.5, 0., 1.e-5
*TRS
 20., 8.86, 101.6
*Expansion
 1e-4,
*Step
"""
ANSYS = """\
/COM, units are not said
MP,EX,2,5000000   ! Pa
MP,NUXY,2,0.45
MP,DAMP,2,0.1
TB,PRONY,2,1,2,SHEAR
TBDATA,1,0.3,1.0,0.6
TBDATA,4,10.0
"""
DYNA = """\
*KEYWORD
*MAT_GENERAL_VISCOELASTIC
$      mid        ro      bulk
         7   1.1e-06      2.00
         0
     0.001
     0.010       2.0
     0.100      20.0
*END
"""


def put(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("moduli", ["long_term", "instantaneous"])
@pytest.mark.parametrize("bulk", ["elastic", "proportional"])
@pytest.mark.parametrize("code", CODES)
def test_read_write_read(code: str, bulk: str, moduli: str, paper_rubber: Material, tmp_path: Path) -> None:
    young = 4.17 if moduli == "long_term" else 2900.0
    first = replace(paper_rubber, youngs_modulus=young, moduli=moduli, bulk=bulk)
    name = first.name
    second = rubber(read_deck(put(tmp_path / "first", write_deck(code, first))), name)
    third = rubber(read_deck(put(tmp_path / "second", write_deck(code, second))), name)
    assert third == second
    for kind in ("complex_shear_modulus", "complex_bulk_modulus"):
        assert getattr(second, kind)(FREQUENCY) == pytest.approx(getattr(first, kind)(FREQUENCY), rel=1e-7)


def test_abaqus(tmp_path: Path) -> None:
    deck = read_deck(put(tmp_path / "a.inp", ABAQUS.format(moduli="long term")), units="MPa,s")
    found = rubber(deck, "tread")
    assert found.long_term_shear_modulus == pytest.approx(0.8)
    assert found.long_term_bulk_modulus == pytest.approx(100.0)
    assert found.shear_fractions == pytest.approx((0.3, 0.5))
    assert found.relaxation_times == (1e-3, 1e-5)
    assert found.density == 1.2e-9
    assert deck.shift == Shift("wlf", 20.0, c1=8.86, c2=101.6)
    assert "*EXPANSION in line 13 is not read" in deck.notes
    shifted = ShiftedRubber(found, deck.shift)
    assert read_deck(put(tmp_path / "b.inp", write_deck("abaqus", shifted))).shift == deck.shift
    at_once = rubber(read_deck(put(tmp_path / "c.inp", ABAQUS.format(moduli="instantaneous")), units="MPa,s"), "tread")
    assert at_once.instantaneous_shear_modulus == pytest.approx(0.8)


def test_ansys_in_pascal(tmp_path: Path) -> None:
    deck = read_deck(put(tmp_path / "a.mac", ANSYS), units="Pa,ms")
    found = rubber(deck, "tread")
    assert found.instantaneous_shear_modulus == pytest.approx(5.0 / 2.9)
    assert found.relaxation_times == pytest.approx((1e-3, 1e-2))
    assert any("MP,DAMP" in note for note in deck.notes)
    assert any("instantaneous" in note for note in deck.notes)


def test_lsdyna_in_gigapascal_and_milliseconds(tmp_path: Path) -> None:
    found = rubber(read_deck(put(tmp_path / "a.k", DYNA), units="GPa,ms"), "tread")
    assert found.long_term_shear_modulus == pytest.approx(1.0)
    assert found.branch_shear_moduli == pytest.approx([10.0, 100.0])
    assert found.relaxation_times == pytest.approx((0.5e-3, 0.05e-3))
    assert found.long_term_bulk_modulus == pytest.approx(2000.0)
    assert found.density == pytest.approx(1.1e-9)  # kg/mm³


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ABAQUS.replace("mooney-rivlin", "ogden, n=1"), "*HYPERELASTIC with OGDEN, N, MODULI in line 5"),
        (ABAQUS.replace("time=PRONY", "time=FREQUENCY DATA"), "only TIME=PRONY is read"),
        (ABAQUS.replace("0.2, 0.0, 1.e-3", "0.2, 0.1, 1.e-2"), "has bulk terms 0.1, 0, 0 beside shear terms"),
        (ABAQUS.replace("0.5, 0., 1.e-5", "0.7, 0., 1.e-5"), "add up to 1, by rounding, so that Tread would"),
        (ABAQUS.replace("0.5, 0., 1.e-5", "0.9, 0., 1.e-5"), "add up to 1.2, but must stay below 1"),
        (ABAQUS.replace("0.5, 0., 1.e-5", "0.5, 0., -1.e-5"), "times must be positive"),
        (ABAQUS.replace("0.3, 0.1, 0.02", "0.3, 0.1, 0."), "is incompressible, but the model needs"),
        (ABAQUS.replace("0.3, 0.1, 0.02", "3e6, 1e6, 2e-9"), "Pa for one, with --units"),
        (ABAQUS.replace("0.3, 0.1, 0.02", "0.3, x, 0.02"), "in line 6, but must have numbers"),
        (ANSYS.replace("MP,EX,2,5000000", "MP,REFT,2,20"), "has no elastic constants for 2"),
        (ANSYS.replace("TB,PRONY,2,1", "TB,PRONY,2,3"), "at 3 temperatures"),
        (DYNA.replace("     0.001\n", ""), "has no term with beta = 0"),
        (DYNA.replace("      20.0", "      20.0       1.0       5.0"), "bulk terms at other rates"),
        (DYNA.replace("         0\n", "         5\n"), "as a relaxation curve"),
        ("nothing of the kind", "has no Prony series of a code that is known"),
    ],
)
def test_what_the_model_does_not_hold_is_named(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput) as caught:
        rubber(read_deck(put(tmp_path / "deck", text.format(moduli="long term")), units="MPa,s"), "tread")
    assert words in str(caught.value)


def test_units_and_materials_are_asked_for(tmp_path: Path) -> None:
    path = put(tmp_path / "a.inp", ABAQUS.format(moduli="long term"))
    with pytest.raises(InvalidInput, match="does not say its units"):
        read_deck(path)
    with pytest.raises(InvalidInput, match="--units is 'mPa,s', but must be a unit of stress"):
        read_deck(path, units="mPa,s")
    twice = ABAQUS.replace("Tread", "Wall") + ABAQUS
    path = put(tmp_path / "b.inp", twice.format(moduli="long term"))
    with pytest.raises(InvalidInput, match="2 viscoelastic materials, Wall, Tread: name one with --material"):
        read_deck(path, units="MPa,s")
    assert read_deck(path, units="MPa,s", material="tread").name == "Tread"


def test_shares_that_add_up_to_one_take_a_static_modulus(tmp_path: Path) -> None:
    text = ANSYS.replace("0.3,1.0,0.6", "0.4,1.0,0.6")
    deck = read_deck(put(tmp_path / "a.mac", text), units="Pa,s")
    with pytest.raises(InvalidInput, match="give its Young's modulus at rest with --static-modulus"):
        rubber(deck, "tread")
    found = rubber(deck, "tread", static_modulus=0.5)
    assert found.long_term_shear_modulus == pytest.approx(0.5 / 2.9)
    assert found.instantaneous_shear_modulus == pytest.approx(5.0 / 2.9)


def test_too_many_terms_and_shifts_are_refused(paper_rubber: Material) -> None:
    many = replace(paper_rubber, shear_fractions=(0.05,) * 18, relaxation_times=tuple(np.geomspace(1e-9, 1.0, 18)))
    with pytest.raises(InvalidInput, match="18 branches and a static modulus, but"):
        write_deck("lsdyna", many)
    shifted = ShiftedRubber(paper_rubber, Shift("arrhenius", 20.0, activation_energy=100.0))
    for code in CODES:
        with pytest.raises(InvalidInput, match="written to"):
            write_deck(code, shifted)
