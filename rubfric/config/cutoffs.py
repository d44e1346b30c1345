"""The scenes of a campaign that say which waves of a measured road carry its friction, and how far off sines are."""

from __future__ import annotations

from dataclasses import replace

from rubfric import checks
from rubfric.config.campaign import Campaign
from rubfric.scene.scene import Scene


def cutoff_scenes(campaign: Campaign) -> dict[str, Scene]:
    """Return the windows down to longer cutoffs, and under the same block the sines, by a folder of theirs and name.

    Folders are ``cutoffX/windowN/``, X the cutoff in mm, and ``sines/``. They slide at all speeds, at the pressure and
    the temperature that figures of the whole road show. Without windows that are slid over there are none.

    Parameters
    ----------
    campaign : Campaign
    """
    survey = campaign.survey
    if not (survey and survey.windows and campaign.multiscale.simulated):
        return {}
    shown = (campaign.figures.total_pressure, campaign.figures.temperature)
    whole = campaign.whole_scenes().items()
    scenes = [one for name, one in whole if name.startswith("window1/") and (one.pressure, one.temperature) == shown]
    found = {
        f"{folder(cutoff, number)}{scene.name}": replace(scene, road=road)
        for cutoff, roads in survey.coarser.items()
        for number, road in enumerate(roads, 1)
        for scene in scenes
    }
    aspect = float(f"{survey.block_height / campaign.whole_road.wavelength:.6g}")
    sines = [replace(scene, road=campaign.whole_road, aspect=aspect) for scene in scenes]
    return found | {f"sines/{scene.name}": scene for scene in sines}


def folder(cutoff: float, window: int) -> str:
    """Return the folder of a window, from 1, down to a longer cutoff, mm.

    Parameters
    ----------
    cutoff : float
        mm.
    window : int
        From 1.
    """
    return f"cutoff{checks.written(cutoff)}/window{window}/"
