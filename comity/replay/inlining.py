"""Bundling of ES modules into one script: each becomes a function that returns its exports.

The page is opened from a mail attachment or a USB stick, where browsers refuse to load modules from files. So
the modules are joined when the page is written, in dependency order, each in its own scope. They must use one
form: `import { a, b } from "./other.js";` at the top, and `export` before a function, a class or a constant.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

_IMPORT = re.compile(r'^import \{([^}]*)\} from "\./([a-z_]+)\.js";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function\*?|class|const) +(\w+))", re.MULTILINE)


def joined(modules: Mapping[str, str], entry: str) -> str:
    """One script that runs a module and its dependencies.

    Args:
        modules: Sources by name, without `.js`.
        entry: The module to start with.

    Raises:
        ValueError: if a module is missing, depends on itself, or imports in another form: a programming
            error.
    """
    parts = [_scope(name, modules[name]) for name in _in_order(modules, entry, ())]
    return '"use strict";\n' + "\n".join(dict.fromkeys(parts))


def _in_order(modules: Mapping[str, str], name: str, above: tuple[str, ...]) -> Iterator[str]:
    if name in above:
        raise ValueError(f"modules need each other in a circle: {' > '.join((*above, name))}")
    if name not in modules:
        raise ValueError(f"{above[-1] if above else 'the page'} needs {name}.js, and there is none")
    for found in _IMPORT.finditer(modules[name]):
        yield from _in_order(modules, found[2], (*above, name))
    yield name


def _scope(name: str, source: str) -> str:
    exports = [found[1] for found in _EXPORT.finditer(source)]
    body = _EXPORT.sub("", _IMPORT.sub(_taken, source))
    if stray := re.search(r"^(?:import|export)\b.*", body, re.MULTILINE):
        raise ValueError(f"{name}.js: expected the one form of import and export, got {stray[0]!r}")
    return f"const {name}_js = (() => {{\n{body}return {{ {', '.join(exports)} }};\n}})();\n"


def _taken(found: re.Match[str]) -> str:
    names = " ".join(found[1].split()).replace(" as ", ": ")
    return f"const {{ {names} }} = {found[2]}_js;\n"
