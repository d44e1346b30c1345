"""The virtual rig: it goes where it is sent or says why not, and everything that it writes says simulated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rubfric.config.rig import RigChoice, VirtualRig
from rubfric.errors import InvalidInput
from rubfric.results.friction_map import FrictionMap
from rubfric.rig.files import rig_files
from rubfric.rig.reduction import reduce_files
from rubfric.rig.sensors import MOST_SAMPLES, Ideal, Sensors, recorded
from rubfric.rig.settings import Settings
from rubfric.rig.sled import GRAVITY, Sled
from rubfric.rig.virtual import between, measure, parts_of, plan, simulate, targets

VALUES = (100, "rubber", 5, 100, 300, 0.5, 0.005, 0.2, 0.002, 0.005, 1000, 1)
RIG = VirtualRig(**dict(zip(VirtualRig.model_fields, VALUES, strict=True)))  # type: ignore[arg-type]


def test_targets_lie_on_the_scenes_and_between_them(friction: FrictionMap) -> None:
    assert between(np.array([1.0, 100.0])) == (1.0, 10.0, 100.0)
    found = targets(friction, [1.0], [7.0])
    assert {(0.1, 1.0), (7.0, 1.0), (7.0, 5.0)} < found
    assert (0.1, 5.0) not in found


def test_plan_has_a_run_or_a_reason_for_every_target(friction: FrictionMap, sled: Sled) -> None:
    wanted = [(1.0, 1.0), (5.0, 1.0), (60.0, 1.0), (80.0, 1.0), (9000.0, 1.0), (1.0, 9.0), (0.01, 1.0)]
    runs, beyond = plan(friction, sled, wanted, 100.0)
    assert [run.speed for run in runs] == [1.0, 5.0, 60.0]  # one sweep passes through 60 and 80 mm/s
    assert [run.settles for run in runs] == [True, True, False]
    reasons = [one.rejected[0].reason for one in beyond]
    assert sorted(reasons) == [
        "not reached: even in free fall 240 mm of travel give 2170 mm/s",
        "outside the pressures simulated, 0.1 to 5 MPa",
        "outside the speeds simulated, 0.1 to 10000 mm/s",
    ]


def test_runs_measure_what_was_simulated(friction: FrictionMap, sled: Sled) -> None:
    runs, _ = plan(friction, sled, [(1.0, 1.0), (200.0, 1.0)], 100.0)
    found = list(measure(runs, friction, sled, Sensors(sampling=2000.0), seed=5))
    points = [point for run in found for point in run.points]
    assert {run.source for run in found} == {"simulated"}
    assert max(point.speed for point in points) > 180.0
    assert min(point.speed for point in points) == pytest.approx(1.0, rel=1e-3)
    truth = friction.at(1.0)(np.array([point.speed for point in points]))
    away = np.array([point.friction_coefficient for point in points]) - truth
    assert np.all(np.abs(away) < 2.5 * np.array([point.friction_coefficient_ci95 for point in points]))
    again = list(measure(runs, friction, sled, Sensors(sampling=2000.0), seed=5))
    assert again == found


def test_sensors_that_read_nothing_are_a_reason_and_no_failure(friction: FrictionMap, sled: Sled) -> None:
    runs, _ = plan(friction, sled, [(1.0, 0.1)], 100.0)
    (found,) = measure(runs, friction, sled, Sensors(sampling=500.0, force_noise=1e4), seed=5)
    assert not found.points
    assert "no stretch before loading" in found.rejected[0].reason


def test_sensors_read_what_they_sit_at(steady: Ideal, friction: FrictionMap, sled: Sled) -> None:
    assert steady.time.size <= MOST_SAMPLES
    late = (steady.time > steady.release + 1.0) & (steady.time < steady.release + 1.5)
    np.testing.assert_allclose(steady.normal[late], 100.0)
    np.testing.assert_allclose(steady.traction[late], 100.0 * float(friction.at(1.0)(5.0)), rtol=1e-4)
    assert not steady.normal[steady.time < 0.9].any()
    assert not steady.traction[steady.time < 0.9].any()


def test_noise_has_the_deviation_and_memory_asked_for(steady: Ideal) -> None:
    sensors = Sensors(force_noise=0.5, force_memory=0.004, drift=0.0, normal_offset=0.0, displacement_noise=0.0)
    seeds = (np.random.default_rng(seed) for seed in range(20))
    noise = np.concatenate([recorded(steady, sensors, rng)[1] - steady.normal for rng in seeds])
    assert noise.std() == pytest.approx(0.5, rel=0.02)
    kept = float(np.corrcoef(noise[:-1], noise[1:])[0, 1])
    assert kept == pytest.approx(np.exp(-(steady.time[1] - steady.time[0]) / 0.004), abs=0.02)
    place = recorded(steady, sensors, np.random.default_rng(0))[3]
    np.testing.assert_allclose(place / 0.005, np.round(place / 0.005), atol=1e-9)
    np.testing.assert_allclose(place, steady.displacement, atol=0.0026)


def test_file_says_simulated_and_is_read_back(friction: FrictionMap, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    told = simulate(friction, RIG, 1.0, None, 5.0, path)
    assert told.startswith("virtual rig (simulated): 5.379 kg pull the sled to 5 mm/s in 2 s; stopped after 10 mm\n")
    assert path.read_text().startswith("# rubfric virtual rig (simulated): no measurement\n# 1 MPa, weight 5.37")
    (found,) = reduce_files([str(path)], Settings(area=100.0))
    assert found.source == "simulated"
    assert found.points[-1].speed == pytest.approx(5.0, rel=1e-2)


def test_file_under_a_weight_too_light_or_for_a_speed_too_high_is_not_written(
    friction: FrictionMap, tmp_path: Path
) -> None:
    path = tmp_path / "run.csv"
    with pytest.raises(InvalidInput, match=r"must exceed 0.102 kg: the bearings hold the sled with 1 N"):
        simulate(friction, RIG, 1.0, 0.1, None, path)
    with pytest.raises(InvalidInput, match=r"^speed is 9000 mm/s, but that is not reached: even in free fall"):
        simulate(friction, RIG, 1.0, None, 9000.0, path)
    with pytest.raises(InvalidInput, match=r"^pressure is 9 MPa, but must lie within those simulated"):
        simulate(friction, RIG, 9.0, 1.0, None, path)
    assert not path.exists()


def test_rope_pulls_with_what_the_weight_does_not_need_itself(friction: FrictionMap, tmp_path: Path) -> None:
    rope = RIG.model_copy(update={"traction": "rope"})
    sled, sensors = parts_of(rope)
    assert (sled.mass, sensors.traction, sensors.sampling) == (5.0, "rope", 1000.0)
    simulate(friction, rope.model_copy(update={"force_noise": 0.0}), 1.0, 8.0, None, tmp_path / "run.csv")
    values = np.loadtxt(tmp_path / "run.csv", delimiter=",", comments=["#", "time"])
    time, _, traction, place = values.T
    held = (time > 1.6) & (time < 1.9)
    pull = 8e-3 * GRAVITY
    assert traction[held].mean() + 0.8 == pytest.approx(pull, abs=0.2)
    moving = (place > 5.0) & (place < 250.0)
    acceleration = np.polyfit(time[moving], place[moving], 4)
    second = np.polyval(np.polyder(acceleration, 2), time[moving])
    np.testing.assert_allclose(traction[moving] + 0.8, pull - 8e-3 * second, atol=3.0)


def choice(**changes: object) -> RigChoice:
    return RigChoice.read(
        "rig", {"data": (), "columns": None, "pressures": [1], "speeds": [1], "virtual": RIG} | changes
    )


def test_files_of_the_rig_are_found_or_named(tmp_path: Path) -> None:
    assert rig_files(choice()) == []
    data, pull, columns = (tmp_path / name for name in ("run.csv", "pull.csv", "rig.yaml"))
    data.touch()
    with pytest.raises(InvalidInput, match=r"rig\.columns is None, but must be the path of a YAML file that gives"):
        rig_files(choice(data=(str(data),)))
    with pytest.raises(InvalidInput, match=r"^rig.data\[0\] is '.*absent.csv', but there is no such file$"):
        rig_files(choice(data=(str(tmp_path / "absent.csv"),), columns=str(columns)))
    with pytest.raises(InvalidInput, match=r"^rig.columns is '.*rig.yaml', but there is no such file$"):
        rig_files(choice(data=(str(data),), columns=str(columns)))
    columns.write_text("traction: rope\nsled_mass: 5\n")
    with pytest.raises(InvalidInput, match=r"rig\.yaml lacks the key 'area', the nominal area of the rubber, mm²"):
        rig_files(choice(data=(str(data),), columns=str(columns)))
    columns.write_text("area: 100\ntraction: rope\nsled_mass: 5\nbearing: {file: pull.csv}\n")
    with pytest.raises(InvalidInput, match=r"^bearing.file in .*rig.yaml is '.*pull.csv', but there is no such file$"):
        rig_files(choice(data=(str(data),), columns=str(columns)))
    pull.touch()
    assert rig_files(choice(data=(str(data),), columns=str(columns))) == [str(data), str(columns), str(pull)]


def test_choice_survives_the_way_into_a_job() -> None:
    assert RigChoice.read("rig", choice().model_dump()) == choice()
