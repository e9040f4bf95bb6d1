"""Writes the joints of the package from the list of the library, docs/library.md, which is itself made from the code.

`python tools/library.py` writes `python/kin/library.py`, `python/kin/spatial.py`, `python/kin/_library_names.py` and the loads,
`python/kin/_library_loads.py` and `_library_spatial_loads.py`; with `--check` it says whether they are what it would write.
"""

import re
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
PAGE = HERE.parent / "docs" / "library.md"
TYPES = {
    "Planar": "PlanarLike",
    "Spatial": "SpatialLike",
    "Coord": "CoordinateLike",
    "f64": "NumberLike",
    "Vec2": "Vec2Like",
    "Vec3": "Vec3Like",
    "EulerParameters": "EulerLike",
    "Axis": "AxisLike",
    "Law": "LawLike",
    "[Coord; N]": "Sequence[CoordinateLike]",
    "[f64; N]": "Sequence[NumberLike]",
}
HEAD = '''"""{title}

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from typing import Sequence

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike, SpatialLike
from ._joint import AxisLike, EulerLike, Joint, LawLike, Vec2Like, Vec3Like, joint
'''


LOADS = '''"""{title}

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from ._dimension import NumberLike
from ._handles import {handles}
from ._joint import {kinds}, joint
from ._load import {own}
'''


# What the page calls by its name in Rust, and the same in Python.
NAMES = {
    "`Axis::new(h, f)`": "`kin.Axis(h, f)`", "`Vec3::axis_near`": "`kin.Axis(h, f)`",
    "`EulerParameters::identity()`": "`kin.EulerParameters()`",
}  # fmt: skip


def plain(text):
    """Markdown as text, in the words of Python."""
    for rust, name in NAMES.items():
        text = text.replace(rust, name)
    text = re.sub(r"`(\w+)::(\w+)", r"`\1.\2", text)
    return re.sub(r"\s+", " ", text.replace("\\|", "|").replace("**", "").replace("*", "")).strip()


def functions():
    """Section, name, arguments, equation and description of each function of the page."""
    section, equations = "", {}
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            section = "spatial" if "spatial::" in line else "library" if "prelude" in line else ""
            equations = {}
        cells = re.split(r"(?<!\\)\|", line)
        if section and len(cells) > 4 and "`" in cells[2]:
            equations[re.search(r"`(\w+)`", cells[2]).group(1)] = plain(cells[3])
        found = re.match(r"\* \*\*`(\w+)`\*\* `\((.*?)\)`: (.*)", line)
        if section and found:
            name, arguments, text = found.groups()
            pairs = [re.match(r"(\w+): (.*)", one).groups() for one in re.split(r", (?=\w+: )", arguments)]
            yield section, name, pairs, equations[name], plain(text)


def loads():
    """Section, kind, name, arguments and description of each length, energy and force of the page."""
    section = ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            section = "" if "loads::" not in line else "spatial_loads" if "loads::spatial::" in line else "loads"
        found = re.match(r"\* \*\*`(\w+)`\*\* `\((.*?)\)`, (\w+): (.*)", line)
        if section and found and found[3] != "load":
            pairs = [re.match(r"(\w+): (.*)", one).groups() for one in re.split(r", (?=\w+: )", found[2])]
            yield section, found[3], found[1], pairs, plain(found[4])


def written_load(kind, name, pairs, text):
    """One length, energy or force of the library."""
    if kind == "length":
        return written(name, pairs, "", text)
    types = [(argument, "Along" if kind == "force" and k == 0 else TYPES[of]) for k, (argument, of) in enumerate(pairs)]
    signature = f"def {name}({', '.join(f'{argument}: {of}' for argument, of in types)}) -> Load:"
    if len(signature) > 110:
        signature = f"def {name}(\n" + "".join(f"    {argument}: {of},\n" for argument, of in types) + ") -> Load:"
    given = [f'("{argument}", "{of}", {argument})' for argument, of in pairs]
    call = f'of_library("{name}", [{", ".join(given)}])'
    if kind == "force":
        call = f'along_library("{name}", {pairs[0][0]}, [("x", "Coord", FORCED), {", ".join(given[1:])}])'
    call = textwrap.fill(f"return {call}", 108, initial_indent="    ", subsequent_indent="        ")
    body = textwrap.fill(text, 108, initial_indent="    ", subsequent_indent="    ").strip()
    return f'\n\n{signature}\n    """{body}\n    """\n{call}\n'


def written(name, pairs, equation, text):
    """One function."""
    arguments = ", ".join(f"{argument}: {TYPES[kind]}" for argument, kind in pairs)
    signature = f"def {name}({arguments}) -> Joint:"
    if len(signature) > 110:
        lines = "".join(f"    {argument}: {TYPES[kind]},\n" for argument, kind in pairs)
        signature = f"def {name}(\n{lines}) -> Joint:"
    body = "\n\n".join(
        textwrap.fill(part, 108, initial_indent="    ", subsequent_indent="    ") for part in (equation, text) if part
    )
    given = ", ".join(f'("{argument}", "{kind}", {argument})' for argument, kind in pairs)
    call = textwrap.fill(f"return joint(\"{name}\", [{given}])", 108, initial_indent="    ", subsequent_indent="        ")
    return f'\n\n{signature}\n    """{body.strip()}\n    """\n{call}\n'


def files():
    """Every file with its text."""
    all_functions = list(functions())
    titles = {
        "library": "Joints, couplings and drivers of planar bodies and coordinates.",
        "spatial": "Joints, couplings and drivers of spatial bodies.",
    }
    made = {}
    for section, title in titles.items():
        own = [rest for known, *rest in all_functions if known == section]
        names = "".join(f'    "{name}",\n' for name in sorted(name for name, *_ in own))
        made[f"{section}.py"] = (
            HEAD.format(title=title) + "".join(written(*one) for one in own) + f"\n\n__all__ = [\n{names}]\n"
        )
    all_loads = list(loads())
    for section, title, handles in (
        ("loads", "Loads of planar bodies and coordinates.", "CoordinateLike, PlanarLike"),
        ("spatial_loads", "Loads of spatial bodies.", "SpatialLike"),
    ):
        own = [rest for known, *rest in all_loads if known == section]
        body = "".join(written_load(*one) for one in own)
        kinds = [kind for kind in ("AxisLike", "EulerLike", "Joint", "LawLike", "Vec2Like", "Vec3Like") if kind in body]
        own = [one for one in ("FORCED", "Along", "Load", "along_library", "of_library") if one in body]
        head = LOADS.format(title=title, handles=handles, kinds=", ".join(kinds), own=", ".join(own))
        made[f"_library_{section}.py"] = head + body
    made["_library_names.py"] = (
        '"""Names of the joints and loads of the library. Made by `python tools/library.py`; do not edit."""\n'
        + name_set("LIBRARY", {name for _, name, *_ in all_functions})
        + name_set("LOADS", {name for *_, name, _, _ in all_loads})
    )
    return made


def name_set(name, names):
    """A set of names as Python."""
    lines = "".join(f'        "{one}",\n' for one in sorted(names))
    return f"\n{name} = frozenset(\n    [\n{lines}    ]\n)\n"


if __name__ == "__main__":
    for name, text in files().items():
        path = HERE / "python" / "kin" / name
        if "--check" in sys.argv:
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                sys.exit(f"{name} is not what docs/library.md says: run python tools/library.py")
        else:
            path.write_text(text, encoding="utf-8")
