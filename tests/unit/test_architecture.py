"""The picture of the architecture is of the floors as they are."""

from __future__ import annotations

import re
from xml.etree import ElementTree

from architecture import PICTURE, STOREYS, WAY, picture
from test_floors import FLOORS, MODULES, floor, own_imports

TEXTS = [text.text for text in ElementTree.fromstring(picture()).iter("{http://www.w3.org/2000/svg}text")]


def test_picture_is_of_the_floors_as_they_are() -> None:
    assert PICTURE.read_text(encoding="utf-8") == picture(), "draw it anew: make docs"


def test_every_module_is_in_the_picture() -> None:
    assert {module for modules in FLOORS for module in modules} <= set(TEXTS)


def test_storeys_begin_one_above_the_other_at_the_ground() -> None:
    places = [floor(module) for module in STOREYS]
    assert places[0] == 0
    assert places == sorted(set(places))


def test_way_of_a_scene_leads_through_what_makes_it() -> None:
    assert set(WAY) <= {module.partition(".")[0] for module in MODULES}
    reached = {"simulation"}
    while more := {below for module in reached for below in own_imports(module)} - reached:
        reached |= more
    inside = list(WAY)[list(WAY).index("simulation") : list(WAY).index("dataset")]
    assert set(inside) <= reached


def test_nothing_leaves_the_picture() -> None:
    svg = picture()
    width = float(re.search(r'viewBox="0 0 (\d+)', svg)[1])  # type: ignore[index]
    ends = [float(x) + float(w) for x, w in re.findall(r'<rect x="([\d.]+)" y="[\d.]+" width="([\d.]+)"', svg)]
    assert max(ends[1:]) < width - 400  # after the ground; the words at the right have their room
