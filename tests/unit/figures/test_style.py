from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import style


@pytest.fixture
def figure() -> Figure:
    with style.applied():
        drawn = Figure(figsize=(2.0, 1.5), layout="constrained")
        axes = drawn.subplots()
        axes.plot([0.0, 1.0], [1.0, 2.0], **style.lines(1)[0])
        axes.set_xlabel("Friction coefficient")
    return drawn


@pytest.mark.parametrize("count", [2, 4, 8])
def test_colours_grow_lighter_in_even_steps_of_grey(count: int) -> None:
    linear = np.array([colour[:3] for colour in style.colours(count)]) ** 2.2
    lightness = 116.0 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16.0
    steps = np.diff(lightness)
    assert np.all(steps > 0.5 * (lightness[-1] - lightness[0]) / (count - 1))
    # Dark enough for a line on white paper.
    assert lightness[-1] < 75.0


def test_look_does_not_depend_on_the_user_s_settings(tmp_path: Path) -> None:
    @style.applied()
    def draw() -> Figure:
        figure = Figure(figsize=(1.0, 1.0))
        figure.subplots().plot([0.0, 1.0], [0.0, 1.0])
        return figure

    style.save(draw(), tmp_path / "plain.png")
    with mpl.rc_context({"axes.facecolor": "red", "font.size": 20.0, "savefig.dpi": 50.0}):
        style.save(draw(), tmp_path / "own.png")
    assert (tmp_path / "own.png").read_bytes() == (tmp_path / "plain.png").read_bytes()


def test_saving_writes_both_formats_and_makes_the_folder(figure: Figure, tmp_path: Path) -> None:
    pdf, png = tmp_path / "new" / "folder" / "a.pdf", tmp_path / "new" / "folder" / "a.png"
    style.save(figure, pdf, png)
    assert pdf.read_bytes().startswith(b"%PDF")
    head = png.read_bytes()
    assert head.startswith(b"\x89PNG")
    # 2 by 1.5 inches at 300 dots per inch.
    assert (int.from_bytes(head[16:20]), int.from_bytes(head[20:24])) == (600, 450)
    assert sorted(path.name for path in pdf.parent.iterdir()) == ["a.pdf", "a.png"]


def test_fonts_are_embedded_as_truetype_and_no_date_is_stored(figure: Figure, tmp_path: Path) -> None:
    style.save(figure, tmp_path / "a.pdf")
    content = (tmp_path / "a.pdf").read_bytes()
    assert b"/FontFile2" in content
    assert b"/Type3" not in content
    assert b"CreationDate" not in content


def test_saving_twice_gives_the_same_bytes(figure: Figure, tmp_path: Path) -> None:
    for name in ("first", "second"):
        style.save(figure, tmp_path / f"{name}.pdf", tmp_path / f"{name}.png")
    assert (tmp_path / "first.pdf").read_bytes() == (tmp_path / "second.pdf").read_bytes()
    assert (tmp_path / "first.png").read_bytes() == (tmp_path / "second.png").read_bytes()


def test_interrupted_saving_leaves_the_old_file_and_nothing_else(
    figure: Figure, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "a.pdf"
    target.write_text("old")

    def interrupt(path: Path, **_: object) -> None:
        Path(path).write_text("half")
        raise KeyboardInterrupt

    monkeypatch.setattr(figure, "savefig", interrupt)
    with pytest.raises(KeyboardInterrupt):
        style.save(figure, target)
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_other_formats_are_refused_before_anything_is_written(figure: Figure, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"cannot be saved as .*a\.svg, but its name must end in \.pdf or \.png$"):
        style.save(figure, tmp_path / "a.pdf", tmp_path / "a.svg")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("share", "printed"),
    [
        (0.008, "0.8"),
        (0.0123, "1.3"),
        (0.05, "5"),
        (0.071, "7.1"),
        (0.123, "13"),
        (0.00012345, "0.013"),
        (1.0, "100"),
        (2.001, "201"),
        (0.0, "0"),
        (float("inf"), "inf"),
    ],
)
def test_percentages_are_rounded_up(share: float, printed: str) -> None:
    assert style.percent(share) == f"{printed}\N{NO-BREAK SPACE}%"
