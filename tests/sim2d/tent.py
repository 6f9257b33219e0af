"""A desirability curve shaped like a tent: what poses are chosen by where no rulebook is asked."""


class Tent:
    """A desirability that is 1 at the top and 0 at the far end of its domain."""

    def __init__(self, low: float, high: float, top: float) -> None:
        self.domain = (low, high)
        self.top = top

    def __call__(self, x: float) -> float:
        low, high = self.domain
        return (
            max(0.0, 1.0 - abs(x - self.top) / max(self.top - low, high - self.top))
            if low <= x <= high
            else 0.0
        )

    def height(self, low: float, high: float) -> float:
        return max(self(low), self(high))

    def centroid(self, low: float, high: float) -> float:
        return (low + high) / 2
