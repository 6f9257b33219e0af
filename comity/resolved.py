"""The scenario as it was run, every profile and the rulebook written out: it runs again from this alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from comity_fis.yaml_file import dump_yaml

if TYPE_CHECKING:
    from comity.preparation import Prepared


def resolved_yaml(prepared: Prepared) -> str:
    """The text of `scenario.yaml` in a run folder."""
    content: dict[str, Any] = prepared.file.scenario.model_dump(
        mode="json", by_alias=True, exclude_none=True, exclude={"expect", "matrix", "markers"}
    )
    if prepared.day is not None:
        content["at"] = prepared.day.isoformat()
    content["rulebook"] = prepared.rulebook_file.data
    for name, profile in prepared.profiles.items():
        content["people"][name]["profile"] = profile.model_dump(mode="json", exclude_defaults=True)
    for name, learnt in prepared.learnt.items():
        content["people"][name]["learnt"] = {
            parameter: {"offset": one.offset, "spread": one.spread, "text": one.text}
            for parameter, one in learnt.items()
        }
    content["limits"]["attend_s"] = prepared.attend_s
    return dump_yaml(content)
