from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, fields, replace

import pytest

from rubfric.config.campaign import load
from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]


def test_name_is_canonical(paper_scene: SceneMaker) -> None:
    assert paper_scene(100, 5, plane="stress").name == "scale1_v100_p5_aspect0.75_stress"
    assert paper_scene(0.1, 0.1 + 0.2, scale=4).name == "scale4_v0.1_p0.3_aspect0.75_strain"
    assert paper_scene(1e4, 1e-9).name == "scale1_v10000_p1e-9_aspect0.75_strain"


def test_height_follows_from_aspect_and_wavelength(paper_scene: SceneMaker) -> None:
    assert paper_scene(1.0, 5.0).height == pytest.approx(0.75 * 0.17951958, rel=1e-7)


def test_equal_scenes_are_equal_and_hash_alike(paper_scene: SceneMaker) -> None:
    one, two = paper_scene(0.1 + 0.2, 5), paper_scene(0.3, 5.0)
    assert one == two
    assert hash(one) == hash(two)
    assert one.name == two.name
    assert one.digest == two.digest


def test_parameters_survive_json(paper_scene: SceneMaker) -> None:
    scene = paper_scene(0.1, 5.0, scale=3, numerics=Numerics(contact_nodes=48, row_growth=1.15))
    read = Scene.from_parameters(json.loads(json.dumps(scene.parameters())))
    assert read == scene
    assert read.digest == scene.digest


def test_parameters_are_plain(paper_scene: SceneMaker) -> None:
    parameters = paper_scene(1.0, 5.0).parameters()
    assert parameters["road"] == {"amplitude": 0.015, "wavenumber": 35.0}
    assert parameters["material"]["relaxation_times"][0] == 0.01134034
    assert isinstance(parameters["material"]["shear_fractions"], list)
    assert parameters["numerics"]["contact_nodes"] == 32


def test_from_parameters_leaves_its_argument_alone(paper_scene: SceneMaker) -> None:
    parameters = paper_scene(1.0, 5.0).parameters()
    before = json.dumps(parameters, sort_keys=True)
    Scene.from_parameters(parameters)
    assert json.dumps(parameters, sort_keys=True) == before


@pytest.mark.parametrize(
    "change",
    [
        {"scale": 2},
        {"road": SineScale(0.0151, 35.0)},
        {"road": SineScale(0.015, 35.1)},
        {"velocity": 1.01},
        {"pressure": 5.01},
        {"aspect": 0.76},
        {"plane": "stress"},
        {"numerics": Numerics(contact_nodes=65)},
        {"numerics": Numerics(columns_min=264)},
        {"numerics": Numerics(columns_max=1024)},
        {"numerics": Numerics(row_growth=1.16)},
        {"numerics": Numerics(first_row=0.9)},
        {"numerics": Numerics(output_columns=64)},
        {"numerics": Numerics(accuracy=0.02)},
        {"numerics": Numerics(finite_contact_nodes=25)},
        {"numerics": Numerics(finite_columns_min=136)},
        {"numerics": Numerics(refinements=2)},
        {"numerics": Numerics(dilatation="mean")},
        {"numerics": Numerics(folding=0.0)},
        {"numerics": Numerics(tolerance=1e-7)},
        {"kinematics": "finite"},
        {"kinematics": "auto"},
    ],
)
def test_digest_changes_with_the_scene(paper_scene: SceneMaker, change: dict[str, object]) -> None:
    scene = paper_scene(1.0, 5.0)
    other = replace(scene, **change)
    assert other.digest != scene.digest
    assert other != scene


@pytest.mark.parametrize(
    "change",
    [
        {"name": "other"},
        {"youngs_modulus": 4.18},
        {"poissons_ratio": 0.48},
        {"shear_fractions": (0.1,) * 6},
        {"relaxation_times": (1.0,) * 6},
        {"moduli": "instantaneous"},
        {"bulk": "proportional"},
        {"density": 1.0e-9},
    ],
)
def test_digest_changes_with_the_rubber(
    paper_scene: SceneMaker, paper_rubber: Material, change: dict[str, object]
) -> None:
    scene = paper_scene(1.0, 5.0)
    assert replace(scene, material=replace(paper_rubber, **change)).digest != scene.digest


def test_digest_is_a_sha256(paper_scene: SceneMaker) -> None:
    assert len(bytes.fromhex(paper_scene(1.0, 5.0).digest)) == 32


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"velocity": 0.0}, r"^velocity is 0 mm/s, but must be greater than 0$"),
        ({"velocity": "1e3"}, r"^velocity is the text '1e3', .*write 1\.0e\+3\)$"),
        ({"pressure": -5.0}, r"^pressure is -5 MPa, but must be greater than 0$"),
        ({"pressure": float("nan")}, r"^pressure is nan, but must be a finite number$"),
        ({"aspect": 0}, r"^aspect is 0, but must be greater than 0$"),
        ({"scale": 0}, r"^scale is 0, but must be a whole number of at least 1$"),
        ({"scale": 1.5}, r"^scale is 1\.5, but must be a whole number of at least 1$"),
        ({"kinematics": "finit"}, r"^kinematics is 'finit', but must be one of small, finite, auto \(did you mean fin"),
        ({"plane": "strian"}, r"^plane is 'strian', but must be one of stress, strain \(did you mean strain\?\)$"),
    ],
)
def test_bad_scenes_are_refused(paper_scene: SceneMaker, change: dict[str, object], complaint: str) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        replace(paper_scene(1.0, 5.0), **change)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"contact_nodes": 3}, r"^numerics\.contact_nodes is 3, but must be a whole number of at least 4$"),
        ({"accuracy": 0.0}, r"^numerics\.accuracy is 0, but must be at least 1e-06$"),
        (
            {"finite_columns_min": 2**16},
            r"^numerics\.columns_max is 32768, but must be .* at least 65536$",
        ),
        ({"columns_max": 8.5}, r"^numerics\.columns_max is 8\.5, but must be a whole number"),
        ({"columns_max": 120}, r"^numerics\.columns_max is 120, but must be a whole number of at least 128$"),
        ({"row_growth": 1.0}, r"^numerics\.row_growth is 1, but must be at least 1\.00001$"),
        ({"first_row": "1e0"}, r"^numerics\.first_row is the text '1e0'"),
        ({"refinements": 1.5}, r"^numerics\.refinements is 1\.5, but must be a whole number of at least 0$"),
        ({"dilatation": "point"}, r"^numerics\.dilatation is 'point', but must be one of auto, pointwise, mean"),
        ({"folding": 1.1}, r"^numerics\.folding is 1\.1, but must be at most 1$"),
    ],
)
def test_bad_numerics_are_refused(change: dict[str, object], complaint: str) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        Numerics(**change)


@pytest.mark.parametrize("part", ["road", "material", "numerics"])
@pytest.mark.parametrize("missing", [True, False])
def test_parameters_with_missing_or_unknown_keys_are_refused(paper_scene: SceneMaker, part: str, missing: bool) -> None:
    parameters = paper_scene(1.0, 5.0).parameters()
    if missing:
        del parameters[part]
    else:
        parameters[part]["colour"] = "black"
    with pytest.raises(InvalidInput, match=part if missing else "colour"):
        Scene.from_parameters(parameters)


def test_blocks_too_flat_for_the_mesh_are_refused(paper_scene: SceneMaker) -> None:
    numerics = Numerics(columns_max=1024)
    assert paper_scene(1.0, 5.0, aspect=0.01, numerics=numerics).aspect == 0.01
    with pytest.raises(InvalidInput, match=r"^aspect is 0\.007, but must be at least 0\.00781: so flat a block needs"):
        paper_scene(1.0, 5.0, aspect=0.007, numerics=numerics)


def test_kinematics_is_left_to_the_program_by_default(paper_scene: SceneMaker) -> None:
    parameters = paper_scene(1.0, 5.0).parameters()
    del parameters["kinematics"], parameters["plane"]
    road, rubber = SineScale(**parameters["road"]), Material(**parameters["material"])
    scene = Scene(1, road, 1.0, 5.0, material=rubber)
    assert (scene.plane, scene.kinematics) == ("stress", "auto")
    assert scene.aspect == load().aspect
    with pytest.raises(InvalidInput, match=r"^the scene lacks its material"):
        Scene(1, road, 1.0, 5.0)


def test_name_does_not_tell_the_kinematics(paper_scene: SceneMaker) -> None:
    # A campaign has one kinematics, and a name its place in it.
    assert paper_scene(1.0, 5.0, kinematics="finite").name == paper_scene(1.0, 5.0, kinematics="small").name


def test_parameters_are_the_callers_own(paper_scene: SceneMaker) -> None:
    scene = paper_scene(1.0, 5.0)
    parameters, digest = scene.parameters(), scene.digest
    parameters["material"]["shear_fractions"].append(1.0)
    parameters["numerics"]["accuracy"] = 1.0
    assert scene.parameters() != parameters
    assert scene.digest == digest
    assert [*parameters, "temperature", "measured"] == [field.name for field in fields(Scene)]
    assert json.loads(json.dumps(asdict(scene))) == scene.parameters() | {"temperature": None, "measured": None}


def test_temperature_is_part_of_name_and_digest_where_there_is_one(paper_scene: SceneMaker) -> None:
    scene = paper_scene(1.0, 5.0)
    warm = replace(scene, temperature=20.0)
    assert warm.name == "scale1_v1_p5_T20_aspect0.75_strain"
    assert replace(scene, temperature=-2.5).name == "scale1_v1_p5_T-2.5_aspect0.75_strain"
    assert warm.digest != scene.digest
    for one in (scene, warm):
        assert Scene.from_parameters(json.loads(json.dumps(one.parameters()))) == one
    with pytest.raises(InvalidInput, match="temperature is -273 degC, but must be at least -200"):
        replace(scene, temperature=-273.0)
