"""`comity test` and pytest find the same tests below a folder, whatever lies there."""

from __future__ import annotations

import os
from contextlib import chdir, redirect_stdout, suppress
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st
from plugin import PLUGIN
from rooms import scenario
from sampling import sampled

from comity.testing.collection.folders import PASSED_OVER
from comity.testing.collection.gathering import gathered
from comity_fis import InputError

Tests = set[tuple[str, str]]
"""By the real file and the id: of several ways to one folder, pytest takes all."""
ONE = "one.scenario.yaml"
NAMES = ("a", "b", "site-packages", "ward.scenario.yaml", "build.d", *PASSED_OVER, "x.egg", ".git")
FILES = (ONE, "two.scenario.yaml", "notes.yaml", "pyvenv.cfg", "conda-meta/history", "__init__.py")


class _Collected:
    """A plugin of pytest that keeps what was collected."""

    def __init__(self) -> None:
        self.tests: Tests = set()

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        self.tests = {(os.path.realpath(item.path), item.name) for item in session.items}


def of_pytest(folder: Path) -> Tests:
    collected = _Collected()
    with redirect_stdout(StringIO()):
        pytest.main(
            [*PLUGIN, "--collect-only", "-q", f"--rootdir={folder}", str(folder)], plugins=[collected]
        )
    return collected.tests


def of_comity(folder: Path) -> Tests:
    found: list[tuple[str, str]] = []
    with chdir(folder), suppress(InputError):  # where there is none
        found = [(os.path.realpath(claim.path), claim.id) for claim in gathered([]).claims]
    assert len(found) == len(set(found))
    return set(found)


@st.composite
def trees(draw: st.DrawFn):
    """Folders below each other, files in them, and links from one folder to a later one: none in a circle."""
    folders = [Path()]
    for _ in range(draw(st.integers(1, 6))):
        folders.append(draw(st.sampled_from(folders)) / draw(st.sampled_from(NAMES)))
    folders = list(dict.fromkeys(folders))
    files = draw(st.lists(st.tuples(st.sampled_from(folders), st.sampled_from(FILES)), max_size=8))
    places = st.integers(0, len(folders) - 1)
    ends = draw(st.lists(st.tuples(places, places).filter(lambda ends: ends[0] < ends[1]), max_size=4))
    names = st.sampled_from((*NAMES, "link"))
    links = [(folders[min(pair)], draw(names), folders[max(pair)]) for pair in ends]
    return folders, files, links, draw(st.booleans())


def _grow(root: Path, folders, files, links, broken: bool) -> None:
    for folder in folders:
        (root / folder).mkdir(parents=True, exist_ok=True)
    for folder, name in files:
        path = root / folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(scenario() if name.endswith(".scenario.yaml") else "")
    for folder, name, target in links:
        if not (root / folder / name).exists():
            (root / folder / name).symlink_to(root / target)
    if broken:
        (root / "gone.scenario.yaml").symlink_to(root / "nowhere")


@given(trees())
@sampled(8, suppress_health_check=[HealthCheck.too_slow])
def test_comity_and_pytest_find_the_same_tests(tree):
    with TemporaryDirectory() as name:
        root = Path(name)
        _grow(root, *tree)
        assert of_comity(root) == of_pytest(root)


@pytest.mark.parametrize("over", [*PASSED_OVER, "x.egg", ".git"])
def test_what_pytest_passes_over_is_no_test(over, tmp_path):
    _grow(tmp_path, [Path("a") / over], [(Path("a") / over, ONE), (Path("a"), ONE)], [], broken=False)
    assert len(of_comity(tmp_path)) == 1


def test_a_folder_that_may_not_be_looked_into_is_refused_by_its_name_and_the_others_are_tested(
    tmp_path, monkeypatch
):
    """Who tests as root may look into all: the refusal is the system's in its place."""
    _grow(tmp_path, [Path("locked")], [(Path(), ONE), (Path("locked"), ONE)], [], broken=False)
    scan = os.scandir

    def refusing(folder):
        if Path(folder).name == "locked":
            raise PermissionError(13, "Permission denied")
        return scan(folder)

    monkeypatch.setattr(os, "scandir", refusing)
    found = gathered([str(tmp_path)])
    assert [claim.path for claim in found.claims] == [tmp_path / ONE]
    ((folder, refusal),) = found.refused.items()
    assert folder == tmp_path / "locked"
    assert "a folder that may be looked into, got no permission" in str(refusal)
    assert list(gathered([str(tmp_path / "locked")]).refused) == [folder]


def test_behind_a_link_there_are_tests_and_a_circle_of_links_ends(tmp_path):
    """Pytest goes round until the system stops it, and finds the same file again and again."""
    inside, outside = tmp_path / "inside", tmp_path / "outside"
    _grow(outside, [Path("ward")], [(Path("ward"), ONE)], [], broken=False)
    inside.mkdir()
    (inside / "link").symlink_to(outside)
    (outside / "ward" / "back").symlink_to(outside)
    assert len(of_comity(inside)) == 1
    assert of_comity(inside) == of_pytest(inside)


def test_what_is_there_without_a_link_is_called_so(tmp_path):
    """Whoever adds a link renames no test."""
    _grow(tmp_path, [Path("ward")], [(Path("ward"), ONE)], [(Path(), "a", Path("ward"))], broken=False)
    with chdir(tmp_path):
        assert [claim.path for claim in gathered([]).claims] == [Path("ward") / ONE]


def test_what_leads_to_itself_or_nowhere_is_no_test_and_refused_by_its_name(tmp_path):
    """As a folder it is left out."""
    _grow(tmp_path, [Path("a")], [(Path("a"), ONE)], [], broken=True)
    for name in ("ward", "itself.scenario.yaml"):
        (tmp_path / name).symlink_to(tmp_path / name)
    assert len(of_comity(tmp_path)) == 1
    assert of_comity(tmp_path) == of_pytest(tmp_path)
    with chdir(tmp_path):
        refused = {path.name for path in gathered([]).refused}
    assert refused == {"gone.scenario.yaml", "itself.scenario.yaml"}


@pytest.mark.parametrize("mark", ["pyvenv.cfg", "conda-meta/history"])
def test_a_virtual_environment_is_left_out_whatever_it_is_called(mark, tmp_path):
    _grow(
        tmp_path, [Path("mine")], [(Path("mine"), ONE), (Path("mine"), mark), (Path(), ONE)], [], broken=False
    )
    assert len(of_comity(tmp_path)) == 1
    assert of_comity(tmp_path) == of_pytest(tmp_path)
