"""Published formulas, written from their sources. The name of a function with - for _ is that of its .pull file."""
from dataclasses import dataclass, field
from typing import Callable

FORMULAS = {}


@dataclass
class Formula:
    name: str
    variables: str  # real ones, or "z" for a holomorphic function, "z̄" for one of z and its conjugate
    definition: Callable
    written: Callable  # in the order in which the .pull file computes it; the definition itself where that is the same
    special: list = field(default_factory=list)
    exact: list = field(default_factory=list)  # further points, without neighbours
    count: int = 16  # random points
    near: bool = True
    second: bool = False  # also pure second derivatives
    complex: bool = False

    @property
    def mode(self):
        return {"z": "holomorphic", "z̄": "pair"}.get(self.variables, "real")


def formula(variables, written=None, **more):
    """Registers a definition. Functions of z are complex; so is a real one with `complex`."""

    def register(fn):
        name = fn.__name__.replace("_", "-")
        assert name not in FORMULAS, name
        more.setdefault("complex", variables in ("z", "z̄"))
        FORMULAS[name] = Formula(name, variables, fn, written or fn, **more)
        return fn

    return register


from . import curves, fields, holomorphic, loops, surfaces  # noqa: E402,F401  (they register their formulas)
