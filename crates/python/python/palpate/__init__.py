"""Soft-tissue touch: measure it, fit it, simulate it."""

from palpate._palpate import __version__
from palpate.errors import InputError, PalpateError

__all__ = ["InputError", "PalpateError", "__version__"]
