import subprocess
import sys
from pathlib import Path

import comity_fis

README = Path(__file__).parents[2] / "fis" / "README.md"


def test_importing_the_package_imports_nothing_heavy():
    heavy = ["numpy", "scipy", "skfuzzy", "lark", "pydantic", "yaml"]
    program = f"import sys, comity_fis; print([m for m in {heavy!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_exact_mode_needs_no_numpy():
    program = (
        "import sys, comity_fis; comity_fis.load_rulebook('bruno2017').infer({'individualism': 3}); "
        "print('numpy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_every_name_of_the_front_door_is_there():
    assert all(hasattr(comity_fis, name) for name in comity_fis.__all__)
    assert len(set(comity_fis.__all__)) == len(comity_fis.__all__)


def test_the_readmes_example_runs():
    lines = [
        line.strip() for line in README.read_text(encoding="utf-8").splitlines() if line.startswith("    ")
    ]
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith(lines[-1].split("# ")[1].removesuffix(" m"))
