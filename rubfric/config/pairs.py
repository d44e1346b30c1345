"""Several rubbers and roads of one campaign in words: of which it is, and what no error of its friction covers."""

from __future__ import annotations

from rubfric.config.campaign import Campaign


def which(campaign: Campaign) -> str:
    """Return of which of several rubbers and roads a campaign is; nothing where there is one of each."""
    if not campaign.others:
        return ""
    kinds = zip(
        ("rubber", "road"), (list(dict.fromkeys(names)) for names in zip(*campaign.pairs, strict=True)), strict=True
    )
    named = [f"{what}s {', '.join(names)}" if len(names) > 1 else f"{what} {names[0]}" for what, names in kinds]
    return f"of {' and '.join(named)}, this is {campaign.material.name} on {campaign.road_name}, the first"


def never_covered(campaign: Campaign) -> list[str]:
    """Return what no error of a campaign's friction covers: what ``not_covered`` says, and the law of the rubber."""
    law = "finite strain" if campaign.kinematics == "small" else "the choice of the finite-strain law"
    return [*not_covered(campaign), law]


def not_covered(campaign: Campaign) -> list[str]:
    """Return what no error of the friction of one rubber on one road covers, though it would differ for another."""
    rubber, road, fitted, survey = campaign.material.name, campaign.road_name, campaign.fitted, campaign.survey
    found = []
    if fitted is None:
        found.append(f"data of rubber {rubber}")
    elif not fitted.at(campaign.figures.temperature)[1].samples:
        found.append(f"scatter of the data of rubber {rubber}")
    if len(campaign.whole_roads) < 2:
        sines = ", what its sines leave out of the profile" if survey else ""
        found.append(
            f"other windows of road {road}" if survey and survey.windows else f"other phases of road {road}{sines}"
        )
    return found
