"""Limits linear algebra to one thread in Comity's own processes, on import.

Matrices are small here. Starting a thread per core, as OpenBLAS does by default, took a tenth of the CPU time
of a short run (as measured). This only has an effect if numpy is imported later.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
