"""Finds the line of the user's program that is running."""

from __future__ import annotations

import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def users_line() -> tuple[str, int]:
    """Returns the file and line of the innermost frame that belongs neither to this package nor to NumPy."""
    frame = sys._getframe(1)
    numpy_home = os.path.dirname(np.__file__)
    while frame is not None:
        name = frame.f_code.co_filename
        if not name.startswith((HERE, numpy_home)):
            return name, frame.f_lineno
        if frame.f_back is None:
            break
        frame = frame.f_back
    return "?", 0
