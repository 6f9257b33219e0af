"""One self-contained page that shows an episode: everything in it is read from the folder of a run."""

from comity.replay.page import MARK, replay_page

__all__ = ["MARK", "replay_page"]
