"""Views of an episode: its page, picture and GIF. All of them are made from the folder of a run."""

from comity.replay.page import MARK, replay_page

__all__ = ["MARK", "replay_page"]
