"""One thread for linear algebra, in processes of Comity's own; importing this sets it.

Matrices are small here. Starting a thread for each core, as OpenBLAS does where nobody says otherwise, took a
tenth of the CPU time of a short run (as measured). It counts only where numpy is imported later.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
