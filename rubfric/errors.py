"""The project's exceptions: each is also the builtin that callers expect."""

from __future__ import annotations


class RubfricError(Exception):
    """Base of every error that rubfric raises on purpose."""


class InvalidInput(RubfricError, ValueError):
    """A value that no model can take; the message names the key, the value and what is allowed.

    Parameters
    ----------
    *faults : str
        One sentence, or several on one config, which the message numbers.
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
    """A result file that cannot be read or lacks what every result holds."""


class NotWritten(RubfricError, OSError):
    """A file that the system does not let be written; the message says why and what to do."""
