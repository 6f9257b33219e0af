"""The planner and the tree of a stage on which only the world moves."""


class Nobody:
    """A planner and a tree to which nothing happens."""

    def tell(self, person, values, text) -> None:
        raise AssertionError("nothing is said here")

    def note(self, about, text, fault) -> None:
        raise AssertionError("no door waits here")

    def break_down(self, error, calls) -> None:
        raise AssertionError("nothing breaks down here")

    def raise_in(self, leaf, error, *, times=1) -> None:
        raise AssertionError("nothing raises here")
