"""Completion in the shell: the script is one of the shell, and completes commands, options, files and words."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from rubfric import cli

TRY = """
source {script}
for line in "rubfric fri" "rubfric friction --pre" "rubfric friction --config mi" "rubfric export --to ab"; do
    COMP_WORDS=($line); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _shtab_rubfric; echo "${{COMPREPLY[*]}}"
done
"""


def printed(shell: str, capsys: pytest.CaptureFixture[str]) -> str:
    with pytest.raises(SystemExit) as ended:
        cli.main(["--print-completion", shell])
    assert not ended.value.code
    return capsys.readouterr().out


def test_bash_completes_commands_options_files_and_words(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("shtab")
    script = tmp_path / "rubfric.bash"
    script.write_text(printed("bash", capsys))
    (tmp_path / "mine.yaml").touch()
    subprocess.run(["bash", "-n", str(script)], check=True)
    tried = subprocess.run(
        ["bash", "-c", TRY.format(script=script)], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert tried.stdout.splitlines() == ["friction", "--pressure", "mine.yaml", "abaqus"]


@pytest.mark.parametrize(("shell", "mark"), [("zsh", "#compdef rubfric"), ("tcsh", "complete rubfric")])
def test_other_shells_have_a_script_of_their_own(shell: str, mark: str, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("shtab")
    assert mark in printed(shell, capsys)


def test_without_the_library_a_sentence_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "shtab", None)
    with pytest.raises(SystemExit) as ended:
        cli.main(["--print-completion", "bash"])
    assert ended.value.code == 2
    assert capsys.readouterr().err == (
        "rubfric: --print-completion needs the library shtab: pip install 'rubfric[completion]'\n"
    )
