"""Take the picture of the page that the README shows: python tests/support/picture.py, after a run of the campaign."""

from __future__ import annotations

import argparse
import base64
import io
import tempfile
from pathlib import Path

from PIL import Image
from visit import console_errors, open_explorer, resize, start

ROOT = Path(__file__).resolve().parents[2]
WIDTH, HEIGHT = 1400, 900


def main(page: Path, output: Path, choice: str) -> None:
    """Write what a screen of 1400 by 900 pixels shows of ``page`` at ``choice`` (the part after #) as PNG."""
    with tempfile.TemporaryDirectory() as profile:
        browser = start(Path(profile))
        try:
            resize(browser, WIDTH, HEIGHT)
            open_explorer(browser, page, choice)
            taken = browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})
            complaints = console_errors(browser)
        finally:
            browser.quit()
    if complaints:
        raise SystemExit(f"the page complains: {complaints[0]}")
    picture = Image.open(io.BytesIO(base64.b64decode(taken["data"]))).convert("RGB")
    picture.save(output, optimize=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=Path, nargs="?", default=ROOT / "results" / "explorer.html")
    parser.add_argument("output", type=Path, nargs="?", default=ROOT / "docs" / "explorer.png")
    parser.add_argument("--choice", default="scale=1&view=curves&pressure=5&speed=500")
    main(**vars(parser.parse_args()))
