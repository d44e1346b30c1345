"""The texts of the report: each renders, without a complaint, for every config."""

from __future__ import annotations

import re
from copy import deepcopy
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import yaml
from docutils.core import publish_parts
from jinja2 import Environment, StrictUndefined

ROOT = Path(__file__).resolve().parents[2]
TEXTS = sorted((ROOT / "workflow" / "report").glob("*.rst"))
RULES = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "workflow" / "rules").glob("*.smk")))
FIGURES = {"campaign_figure": ["fig1", "fig3", "fig6"], "field_figure": ["fig2", "fig4"]}
FIGURES |= {"accuracy_figure": ["pareto", "calibration"], "total_figure": ["fig7", "fig10"]}


def overlay(base: dict[str, Any], above: dict[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in above.items():
        merged[key] = overlay(base[key], value) if isinstance(value, dict) and key in base else value
    return merged


def configs() -> dict[str, dict[str, Any]]:
    """Return the project's configs, and one of a bare rubber with an odd name on a flat road."""
    paper, minimal = (
        yaml.safe_load((ROOT / "config" / name).read_text(encoding="utf-8")) for name in ("config.yaml", "minimal.yaml")
    )
    odd = deepcopy(paper) | {"rubber": "soft_" * 20, "road": "_"}
    odd["rubbers"] = {"soft_" * 20: {"youngs_modulus": 1, "poissons_ratio": 0, "shear_fractions": []}}
    odd["rubbers"]["soft_" * 20]["relaxation_times"] = []
    odd["roads"] = {"_": [{"amplitude": 0, "wavenumber": 1}]}
    odd["numerics"] = paper["numerics"] | {"accuracy": 0.05}
    odd["rig"] = {"data": ["run_1.csv", "run_2.csv"]}
    street = {"road": "street", "roads": {"street": {"profile": "street.csv", "windows": 3}}}
    street |= {"rubber": "mine", "rubbers": {"mine": {"measurements": "dma.csv"}}}
    drawn = overlay(paper, {"phases": {"draws": 4}})
    return {"paper": paper, "minimal": overlay(paper, minimal), "odd": odd, "drawn": drawn, "measured": paper | street}


CONFIGS = configs()


def render(path: Path, config: dict[str, Any], figure: str = "fig1", files: list[Any] | None = None) -> str:
    """Return a text as HTML, as Snakemake makes it."""
    environment = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    about = SimpleNamespace(
        config=config,
        wildcards=SimpleNamespace(figure=figure, scale="1"),
        params=SimpleNamespace(aspect=0.75),
        output=["a"],
    )
    text = environment.from_string(path.read_text(encoding="utf-8")).render(
        snakemake=about, files=files or [], categories={}
    )
    return publish_parts(text, writer="html", settings_overrides={"report_level": 1, "halt_level": 1})["html_body"]


@pytest.mark.parametrize("config", CONFIGS)
@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.stem)
def test_text_renders_without_a_complaint(path: Path, config: str) -> None:
    for figure in FIGURES.get(path.stem, ["fig1"]):
        html = render(path, CONFIGS[config], figure)
        assert "system-message" not in html
        assert not re.search(r"\{[{%]|None|Undefined", html)
        assert len(re.sub(r"<[^>]*>", "", html)) > 100


def test_every_text_that_the_rules_name_is_there() -> None:
    named = set(re.findall(r"\.\./report/(\w+)\.rst", RULES))
    assert named
    assert named <= {path.stem for path in TEXTS}
