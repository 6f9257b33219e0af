"""Balanced Latin squares: each condition is equally often at each position and after each other one."""

from __future__ import annotations


def balanced_orders(count: int) -> tuple[tuple[int, ...], ...]:
    """A balanced Latin square (Williams 1949): orders of the numbers from 0 to `count` - 1.

    Each number occurs once at each position, and once directly after each other number. For an odd number of
    conditions there are two squares, the second one mirrored, so that each count is two.

    Args:
        count: Number of conditions, at least 1.
    """
    # 0, 1, n-1, 2, n-2, ...: neighbours have every difference once, so that shifts of it are balanced.
    first = [0, *(step // 2 + 1 if step % 2 == 0 else count - step // 2 - 1 for step in range(count - 1))]
    square = tuple(tuple((one + shift) % count for one in first) for shift in range(count))
    if count % 2 == 0 or count == 1:
        return square
    return (*square, *(order[::-1] for order in square))
