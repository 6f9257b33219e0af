"""Studies: the same visits for many people, rulebooks, seeds and settings, as one table."""

from comity.study.results import Study

__all__ = ["Study"]
