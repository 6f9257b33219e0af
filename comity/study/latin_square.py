"""Orders of conditions in which each stands at each place, and after each other one, equally often."""

from __future__ import annotations


def balanced_orders(count: int) -> tuple[tuple[int, ...], ...]:
    """A balanced Latin square (Williams 1949): orders of the numbers from 0 to `count` - 1.

    Each number is once at each place, and directly after each other number once; of an odd number of
    conditions these are two squares, the second one mirrored, and everything happens twice.

    Args:
        count: Conditions, at least 1.
    """
    # 0, 1, n-1, 2, n-2, ...: neighbours have every difference once, so that shifts of it are balanced.
    first = [0, *(step // 2 + 1 if step % 2 == 0 else count - step // 2 - 1 for step in range(count - 1))]
    square = tuple(tuple((one + shift) % count for one in first) for shift in range(count))
    if count % 2 == 0 or count == 1:
        return square
    return (*square, *(order[::-1] for order in square))
