"""Config files on Snakemake's command line: a sentence for what Snakemake answers with a traceback."""

from __future__ import annotations

from pathlib import Path

import pytest

from rubfric.runner.early import check_given


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"# gr\xfcn\nplane: strain\n", "mine.yaml is not valid YAML: "),
        ("plane: strain\n".encode("utf-16"), "mine.yaml is not valid YAML: "),
        (b"plane:\tstrain\n\t- x", "mine.yaml is not valid YAML: "),
        (b"# nothing yet\n", "mine.yaml holds nothing, but must hold the keys results, "),
        (b"plane: stress\nplane: strain\n", "mine.yaml has the key 'plane' twice"),
        (None, "there is no file mine.yaml (did you mean mines.yaml?)."),
    ],
)
def test_file_that_is_no_config_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: bytes | None, says: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mines.yaml").write_text("plane: strain\n", encoding="utf-8-sig")
    if content is not None:
        Path("mine.yaml").write_bytes(content)
    check_given(["snakemake", "-n", "--configfile", "mines.yaml", "-j2", "mine.yaml"])  # the last is a target
    for arguments in (["--configfile", "mines.yaml", "mine.yaml", "-n"], ["--configfiles=mine.yaml"]):
        with pytest.raises(SystemExit) as caught:
            check_given(["snakemake", *arguments])
        assert str(caught.value).startswith(f"The config is wrong: {says}")
