"""When Python looks for objects in circles that nobody needs any more; importing this sets it.

For processes of Comity's own, and no part of `import comity`: in another person's program it is theirs.
"""

from __future__ import annotations

import atexit
import gc

MANY = 1_000_000
"""So many objects are made before. Python's own number, 700, takes a tenth of the time in which `comity test`
imports and gathers what ships, and a fifteenth of a test's (as measured): nearly all of it is needed to the
end, or goes by itself when its episode does. At 20,000 it still took a twentieth of the time of 200 tests;
at 500,000 it looked twice, for 0.2 and 0.4 s of 20, and without any looking these tests take 100 MB more."""

gc.set_threshold(MANY)
"""Where it is imported, so that it holds while the others are: also in a server that can only import."""
atexit.register(gc.freeze)
"""Not at the end, either: memory goes back as a whole then, and looking through all of it took a seventh of
the time of a process that does no more than import (as measured)."""
