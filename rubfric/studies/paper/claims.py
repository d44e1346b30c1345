"""What the paper claims (Zhou, Wang and Wei 2019), the parts that each claim is judged by, and one number on a part."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Claim:
    """A claim of the paper.

    Attributes
    ----------
    figure : str
        Where the paper shows it.
    says : str
        The claim in a sentence.
    parts : dict of str to str
        By the name of the part: the quantity that decides it, dimensionless.
    """

    figure: str
    says: str
    parts: dict[str, str]


CLAIMS: dict[str, Claim] = {
    "C1": Claim(
        "Fig. 1",
        "Friction rises with the height-to-width ratio below the peak speed; above it the ratios hardly differ.",
        {
            "rises below the peak": "friction of the tallest block over that of the flattest, less 1",
            "hardly differs above the peak": "range of friction over the ratios, over its mean",
        },
    ),
    "C2": Claim(
        "Fig. 2",
        "Strain-energy density falls with distance from the road, towards a steady value.",
        {
            "lower at the top than at the road": "density at the road less that at the top, over the largest",
            "falls all the way": "largest rise with distance from the road, over the largest density",
            "settles": "range of density in the third of the block away from the road, over the largest",
        },
    ),
    "C3": Claim(
        "Fig. 3",
        "Friction is stable for height-to-width ratios from 0.75 up, at every speed.",
        {"stable from 0.75 up": "range of friction over the ratios from 0.75 up, over its mean"},
    ),
    "C4": Claim(
        "Fig. 4",
        "At low pressure or high speed rubber does not fill the profile; at high pressure or low speed it does.",
        {
            "open when light and fast": "contact fraction at the lowest pressure and highest speed",
            "filled when heavy and slow": "contact fraction at the highest pressure and lowest speed",
            "fills with pressure": "contact fraction at the highest pressure less that at the lowest",
            "opens with speed": "contact fraction at the lowest speed less that at the highest",
        },
    ),
    "C5": Claim(
        "Fig. 5",
        "Friction saturates with the steps of sliding.",
        {"saturates": "variation of friction over the memory of the rubber, or over all wavelengths slid"},
    ),
    "C6": Claim(
        "Fig. 6",
        "At each scale friction has an interior maximum over speed, and varies with pressure.",
        {
            "peaks over speed": "largest friction between the ends over the larger of the ends, less 1",
            "varies with pressure": "range of friction over the pressures, over the largest",
        },
    ),
    "C7": Claim(
        "Fig. 7",
        "So does the total over the scales, at 5 MPa.",
        {
            "the whole road peaks": "largest total between the ends over the larger of the ends, less 1",
            "the sum peaks": "largest sum over the scales between the ends over the larger of the ends, less 1",
        },
    ),
    "C8": Claim(
        "Fig. 9",
        "On the test rig friction rises with speed, and falls past a peak.",
        {
            "rises to a peak": "largest friction over that at the lowest speed, less 1",
            "falls past the peak": "largest friction over that at the highest speed, less 1",
        },
    ),
    "C9": Claim(
        "Section 2.2",
        "The friction of the whole road is the sum of the coefficients of its scales.",
        {"the sum is the total": "difference of the sum over the scales from all scales at once, over the latter"},
    ),
}


@dataclass(frozen=True)
class Evidence:
    """One number for or against a claim.

    Attributes
    ----------
    claim, part : str
        Keys of ``CLAIMS`` and of the claim's ``parts``.
    scale : int, optional
    pressure : float, optional
        Nominal, MPa.
    velocity : float, optional
        mm/s.
    value, error : float
        Dimensionless; the error absolute, and NaN where it was not estimated.
    limit : float
    sense : {"above", "below"}
        Where the value has to be for the claim to hold.
    simulated : bool
        Whether it rests on a simulated measurement.
    outcome : {"yes", "no", "open"}
        ``open`` where the limit is within the error of the value.
    """

    claim: str
    part: str
    scale: int | None
    pressure: float | None
    velocity: float | None
    value: float
    error: float
    limit: float
    sense: str
    simulated: bool = False

    @property
    def margin(self) -> float:
        """How far the value is on the right side of its limit; negative on the wrong one."""
        return self.value - self.limit if self.sense == "above" else self.limit - self.value

    @property
    def outcome(self) -> str:
        """Whether the value supports the claim: yes, no, or open."""
        error = 0.0 if np.isnan(self.error) else self.error
        if abs(self.margin) <= error:
            return "open"
        return "yes" if self.margin >= 0.0 else "no"
