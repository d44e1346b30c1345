"""The project's exceptions: each is also the builtin that callers expect."""

from __future__ import annotations


class RubfricError(Exception):
    """Base of every error that rubfric raises on purpose.

    Examples
    --------
    >>> import rubfric
    >>> try:
    ...     rubfric.load({"plane": "bent"})
    ... except rubfric.RubfricError as error:
    ...     print(error)
    plane is 'bent', but must be one of stress, strain
    """


class InvalidInput(RubfricError, ValueError):
    """A value that no model can take; the message names the key, the value and what is allowed.

    Parameters
    ----------
    *faults : str
        One sentence, or several on one config, which the message numbers.

    Examples
    --------
    >>> import rubfric
    >>> rubfric.SineScale(amplitude=-0.01, wavenumber=35)
    Traceback (most recent call last):
    rubfric.errors.InvalidInput: road.amplitude is -0.01 mm, but must be at least 0
    """

    @property
    def faults(self) -> tuple[str, ...]:
        """The sentences, one for each fault."""
        return self.args

    def __str__(self) -> str:
        if len(self.args) < 2:
            return super().__str__()
        return f"there are {len(self.args)} faults" + "".join(
            f"\n  {place}. {fault}" for place, fault in enumerate(self.args, 1)
        )


class NotConverged(RubfricError, RuntimeError):
    """A scene for which no solution was found; no result is written.

    Parameters
    ----------
    scene : str
        Canonical name of the scene, or what stands for it.
    step : int
        Iteration at which the solver gave up.
    residual : float
        What was left, in the measure named by ``measure``.
    measure : str
        What ``residual`` counts, with its unit.
    advice : str
        What may help; nothing where the solver cannot tell.

    Examples
    --------
    >>> import rubfric
    >>> try:
    ...     raise rubfric.NotConverged("scale1_v100_p5_aspect0.75_stress", 12, 0.03, "residual", "lower the pressure")
    ... except rubfric.NotConverged as error:
    ...     print(error)
    scale1_v100_p5_aspect0.75_stress: not converged after 12 steps, residual is 0.03; lower the pressure
    """

    def __init__(self, scene: str, step: int, residual: float, measure: str, advice: str = "") -> None:
        # All five go to Exception, so that the error survives pickling between processes.
        super().__init__(scene, step, residual, measure, advice)
        self.scene = scene
        self.step = step
        self.residual = residual
        self.measure = measure
        self.advice = advice

    def __str__(self) -> str:
        found = f"{self.scene}: not converged after {self.step} steps, {self.measure} is {self.residual:.3g}"
        return f"{found}; {self.advice}" if self.advice else found


class BrokenResult(RubfricError, OSError):
    """A result file that cannot be read or lacks what every result holds.

    Examples
    --------
    >>> import rubfric
    >>> from rubfric.results.dataset import read
    >>> try:
    ...     read("nowhere.nc")
    ... except rubfric.BrokenResult as error:
    ...     print(str(error)[:10])
    nowhere.nc
    """


class NotWritten(RubfricError, OSError):
    """A file that the system does not let be written; the message says why and what to do.

    Examples
    --------
    >>> import rubfric
    >>> result = rubfric.simulate(rubfric.load().scene(scale=1, velocity=100, pressure=0.5, kinematics="small"))
    >>> try:
    ...     rubfric.write(result, "/dev/null/scene.nc")
    ... except rubfric.NotWritten as error:
    ...     print("no file is left")
    no file is left
    """
