"""The page of a study in a real browser: readable in light and dark, wide and narrow, and on grey paper."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.study import Study
from comity.study.report.reporting import write_report
from comity.study.statement import STATEMENT
from tests.browser.moments import weak_texts
from tests.study.test_study_report import visits


@pytest.fixture(scope="module")
def page_file(tmp_path_factory) -> Path:
    """The report of a study with two rulebooks, two groups, failures and an outlier."""
    base = tmp_path_factory.mktemp("study")
    visits(
        base / "study",
        lambda book, person, seed: 3.0 if (book, person, seed) == (0, 3, 1) else book + person / 100,
        outcome=lambda row: "unreached" if row["row"] == 2 else "greeted",
        reason=lambda row: "no <free> place" if row["row"] == 2 else "",
        greeted_s=lambda row: row["row"] / 7,
    )
    write_report(Study.load(base / "study"), base / "report", (), lambda rows: {})
    return base / "report/index.html"


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 360])
def test_every_text_stands_out_and_nothing_leaves_the_screen(reader, page_file, scheme, width):
    reader.page.set_viewport_size({"width": width, "height": 800})
    reader.page.emulate_media(color_scheme=scheme)
    page = reader.open(page_file)
    assert weak_texts(page) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_the_page_says_what_its_differences_are_at_its_head_and_foot(reader, page_file):
    page = reader.open(page_file)
    assert page.locator(".statement").all_inner_texts() == [STATEMENT] * 2
    assert page.locator("main figure svg[role=img]").count() == page.locator("main figure").count() > 2


def test_a_failure_is_listed_with_its_reason_and_the_command_that_plays_it_again(reader, page_file):
    page = reader.open(page_file)
    (row,) = page.locator("#failures tbody tr").all()
    assert "no <free> place" in row.inner_text()
    assert "comity study show DIR --row 2" in row.inner_text()
    assert page.locator("#outliers tbody tr").count() == 2  # either of two seeds may be the odd one


def test_every_link_within_the_page_leads_somewhere(reader, page_file):
    page = reader.open(page_file)
    for link in page.locator("nav a").all():
        assert page.locator(link.get_attribute("href")).count() == 1
    for link in page.locator(".files a").all():
        assert (page_file.parent / link.get_attribute("href")).is_file()


def test_the_page_is_dark_ink_on_white_on_paper_whatever_the_screen_has(reader, page_file):
    reader.page.emulate_media(color_scheme="dark", media="print")
    page = reader.open(page_file)
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert page.evaluate("getComputedStyle(document.body).color") == "rgb(34, 37, 43)"
    assert page.locator("nav").is_hidden()
