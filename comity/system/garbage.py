"""Configuration of Python's cyclic garbage collector, applied on import.

Only for Comity's own processes, not for `import comity`: another program chooses its own settings.
"""

from __future__ import annotations

import atexit
import gc

MANY = 1_000_000
"""Number of allocations before a collection. Python's default, 700, takes a tenth of the time in which
`comity test` imports and collects the shipped tests, and a fifteenth of a test's time (as measured): nearly
all objects are needed until the end, or are freed by reference counting with their episode. At 20,000 it
still took a twentieth of the time of 200 tests; at 500,000 it ran twice, for 0.2 and 0.4 s of 20 s. Without
any collection these tests take 100 MB more."""

gc.set_threshold(MANY)
"""Set on import, so that it applies while other modules are imported, including in a server that can only
import."""
atexit.register(gc.freeze)
"""No collection at exit either: all memory is released at once then, and a collection took a seventh of the
time of a process that only imports (as measured)."""
