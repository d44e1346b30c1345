from __future__ import annotations

import subprocess
import sys


def test_warming_up_uses_everything_without_a_word() -> None:
    done = subprocess.run(
        [sys.executable, "-c", "import rubfric.runner.warm, sys; print('rubfric.figures.fig4' in sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert (done.stdout, done.stderr) == ("True\n", "")
