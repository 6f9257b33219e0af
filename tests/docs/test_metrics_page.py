"""The page about metrics lists every metric as it is defined; `make tables` writes it again."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from comity.testing.measuring.measured import TESTED
from comity_sim2d import EPISODE, VISIT, Metric
from tests.docs.tables import Tables, markdown, write, written

PAGE = "metrics.md"


def table(metrics: Mapping[str, Metric], *, per: bool = False) -> str:
    head = ["name", "unit", "definition", *(["per"] if per else []), "source"]
    rows = [
        [f"`{name}`", one.unit.removeprefix("1"), one.means, *([one.per] if per else []), one.source]
        for name, one in metrics.items()
    ]
    return markdown(head, rows)


TABLES: Tables = {
    "per_run": lambda: table(EPISODE),
    "per_visit_and_person": lambda: table(VISIT, per=True),
    "compared": lambda: table(TESTED),
}


@pytest.mark.parametrize("name", TABLES)
def test_the_page_has_each_metric_as_it_is_defined(name):
    """If this fails because a metric is new: `make tables`."""
    tables = written(PAGE)
    assert tables.keys() == TABLES.keys()
    assert tables[name] == TABLES[name]()


if __name__ == "__main__":
    write(PAGE, TABLES)
