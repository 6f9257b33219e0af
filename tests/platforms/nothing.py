"""A package that can be imported and has every name and submodule, each of which does nothing.

Copied as `__init__.py` of a folder it takes the place of the library of the folder's name.
"""

from __future__ import annotations

import sys
from abc import ABCMeta
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


class _Kind(ABCMeta):
    """Classes with every attribute."""

    def __getattr__(cls, name: str) -> object:
        return _nothing(name)


class Nothing(metaclass=_Kind):
    """Takes any call, and is empty."""

    def __init__(self, *values: object, **named: object) -> None: ...

    def __call__(self, *values: object, **named: object) -> object:
        return Nothing()

    def __getattr__(self, name: str) -> object:
        return _nothing(name)

    def __iter__(self) -> object:
        return iter(())


def _nothing(name: str) -> Nothing:
    if name.startswith("__"):
        raise AttributeError(name)
    return Nothing()


class _Stub(ModuleType):
    """A module with every class."""

    def __getattr__(self, name: str) -> object:
        if name.startswith("__"):
            raise AttributeError(name)
        return _Kind(name, (Nothing,), {})


class _Submodules(MetaPathFinder, Loader):
    def find_spec(self, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        return ModuleSpec(name, self, is_package=True) if name.startswith(f"{__name__}.") else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return _Stub(spec.name)

    def exec_module(self, module: ModuleType) -> None: ...


sys.modules[__name__].__class__ = _Stub
sys.meta_path.insert(0, _Submodules())
