"""Draw the block on the whole road, from the results of some scenes, refused ones among them."""

from rubfric.figures import fig11
from rubfric.figures.style import save
from rubfric.figures.temperature import name_temperature
from rubfric.results.dataset import read


def main(
    results: list[str],
    digests: list[str],
    outputs: list[str],
    draws: int,
    temperature: float | None,
    windows: bool = False,
) -> None:
    """Draw figure 11 and save it under every path of ``outputs``.

    Parameters
    ----------
    results, digests : list of str
        Paths of the results or refusals (netCDF), and the digests that they must have.
    outputs : list of str
        Paths; their endings choose the formats.
    draws : int
        Roads with random phases, of which the results are of the first; 0 where phases are given.
    windows : bool
        Whether they are windows of a measured profile instead.
    temperature : float or None
        That of the results, degC, which the figure names.
    """
    scenes = [read(path, digest, refusals=True) for path, digest in zip(results, digests, strict=True)]
    save(name_temperature(fig11.draw(scenes, draws, windows), temperature), *outputs)
