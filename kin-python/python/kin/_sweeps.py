"""Runs many cases of one system: rows of numbers in, rows of results and statuses out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _native
from ._mistakes import values
from ._names import Named, unknown
from ._motion import array
from ._short import short, shown
from ._system import Progress, System, _Bar, as_bytes

Kept = Union[str, tuple[str, str]]


@values
@dataclass(frozen=True)
class Rows:
    """The results of a sweep.

    `values` has a row for each case and a column for each result. `status` is empty for a case that succeeded. For a
    case that failed, `status` is the text of the error and the results are NaN.
    """

    names: list[str]
    values: Any
    status: list[str]

    def __repr__(self) -> str:
        failed = [(k, one) for k, one in enumerate(self.status) if one]
        text = f"<{len(self.status)} cases of {shown(self.names)}: {len(self.status) - len(failed)} have succeeded"
        if failed:
            text += f", {len(failed)} failed; number {failed[0][0]}: {shown(failed[0][1])}"
        return text + ">"

    @property
    def ok(self) -> Any:
        """True for each case that succeeded."""
        return np.array([not one for one in self.status], dtype=bool)

    def __len__(self) -> int:
        return len(self.status)

    def __getitem__(self, name: str) -> Any:
        if name not in self.names:
            unknown("column", name, self.names)
        return self.values[:, self.names.index(name)]

    def columns(self) -> dict[str, Any]:
        """Returns each result by its name, and `status`."""
        table: dict[str, Any] = Named("column", {name: self.values[:, k] for k, name in enumerate(self.names)})
        table["status"] = np.array(self.status, dtype=object)
        return table

    def to_pandas(self) -> Any:
        """Returns the columns as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_arrow(self) -> Any:
        """Returns the columns as an Arrow table."""
        import pyarrow

        table = self.columns()
        table["status"] = list(self.status)
        return pyarrow.table(table)


def sweep(
    system: System,
    names: Sequence[str],
    cases: Any,
    times: Any,
    keep: Iterable[Kept],
    *,
    lanes: bool = True,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Any,
) -> Rows:
    """Runs the system over the times once for each row of `cases`.

    A row has a number for each of `names`: parameters such as `A.u_i.x` and initial values such as `rocker.theta`.

    `keep` lists the results for each motion: "rocker.theta max", or ("rocker.theta", "max"). For a measure or
    coordinate the results are `max`, `min`, `range`, `first`, `last`, and the largest absolute derivatives `max_rate`
    and `max_second_rate`. For a column of forces, such as `motor` or `A on crank.F_x`, the results are the first five.
    The results use only the given times. For extremes between the times use `system.extremes(motion, …)` or the command
    `kin sweep`. `keep` does not accept a function of a motion.

    Cases run on all cores. If it saves time, one program of the whole mechanism computes many times of a case at once,
    in the lanes of SIMD registers. The step-by-step solver computes a small number of rows, and its last digits differ.
    With `lanes=False` the digits of a case do not depend on the distribution of the rows among machines.
    """
    wanted = [_kept(one) for one in keep]
    rows = np.asarray(cases, dtype=float)
    if rows.ndim == 1:
        rows = rows.reshape(-1, len(names) or 1)
    if rows.ndim != 2 or rows.shape[1] != len(names):
        raise ValueError(f"a case is a row of {len(names)} numbers, one for each name; the array has the shape {rows.shape}")
    with _Bar(progress, system.name) as told:
        data, status = _native.sweep(
            system._native, list(names), as_bytes(rows), as_bytes(times), wanted, options, lanes, threads, told
        )
    return Rows([f"{name} {what}" for name, what in wanted], array(data, len(wanted)), status)


def _kept(one: Kept) -> tuple[str, str]:
    if callable(one) or (isinstance(one, tuple) and callable(one[0])):
        raise TypeError(
            "`keep` takes names of measures, coordinates or forces, such as \"rocker.theta max\", and not a function of a motion: "
            "cases run without Python. Run them one by one with `system.set` and `system.run`, and call `system.measure` for each"
        )
    if isinstance(one, str):
        name, space, what = one.rpartition(" ")
        if not space:
            raise ValueError(f"`{one}` names a measure but not what to keep of it, such as \"{one} max\"")
        return name, what
    name, what = one
    return name, what


@short
@dataclass(frozen=True)
class Batch:
    """A pure function for any engine: the input is a table of cases, the output is the table with results and a status.

    The function and its mechanism can be pickled, so that Ray, Dask, Spark or a pool of processes can send them. The
    digits of a case do not depend on the distribution of the rows. A table is a mapping of columns (`batch(dict)`), a
    pandas DataFrame (`pandas`) or a batch of Arrow (`arrow`). The output contains columns that are not parameters
    without change.
    """

    system: System
    names: tuple[str, ...]
    times: tuple[float, ...]
    keep: tuple[Kept, ...]
    threads: Optional[int] = 1
    options: dict[str, Any] = field(default_factory=dict)

    @staticmethod
    def of(
        system: System,
        names: Sequence[str],
        times: Any,
        keep: Iterable[Kept],
        *,
        threads: Optional[int] = 1,
        **options: Any,
    ) -> "Batch":
        """Creates the function for these parameters, times and results.

        `None` threads means one thread for each core.
        """
        instants = tuple(float(t) for t in times)
        return Batch(system, tuple(names), instants, tuple(keep), threads, options)

    def rows(self, cases: Any) -> Rows:
        """Evaluates rows of numbers in the order of `names`."""
        return sweep(
            self.system,
            self.names,
            cases,
            np.array(self.times),
            self.keep,
            lanes=False,
            threads=self.threads,
            **self.options,
        )

    def _needs(self, columns: Iterable[Any]) -> None:
        """Raises the error of a table that lacks the column of a parameter."""
        given = [str(one) for one in columns]
        for name in self.names:
            if name not in given:
                unknown("column", name, given)

    def __call__(self, table: Mapping[str, Any]) -> dict[str, Any]:
        """Evaluates a mapping of columns, as in `ray.data.Dataset.map_batches(batch)`."""
        self._needs(table)
        columns = [np.asarray(table[name], dtype=float) for name in self.names]
        found = self.rows(np.stack(columns, axis=1))
        return {**{name: table[name] for name in table}, **found.columns()}

    def pandas(self, frame: Any) -> Any:
        """Evaluates a pandas DataFrame, as in `dask.dataframe.DataFrame.map_partitions(batch.pandas)`."""
        self._needs(frame.columns)
        columns = [frame[name].to_numpy(dtype=float) for name in self.names]
        found = self.rows(np.stack(columns, axis=1).reshape(-1, len(self.names))).columns()
        found["status"] = found["status"].astype(str)
        return frame.assign(**{name: values for name, values in found.items()})

    def arrow(self, batch: Any) -> Any:
        """Evaluates a batch or table of Arrow, as in Spark's `frame.mapInArrow(lambda batches: map(batch.arrow,
        batches), schema)`.
        """
        import pyarrow

        self._needs(batch.schema.names)
        columns = [batch.column(batch.schema.get_field_index(name)).to_numpy(zero_copy_only=False) for name in self.names]
        found = self.rows(np.stack([np.asarray(one, dtype=float) for one in columns], axis=1))
        names = list(batch.schema.names) + list(found.names) + ["status"]
        arrays = list(batch.columns) + [pyarrow.array(found.values[:, k]) for k in range(len(found.names))]
        arrays.append(pyarrow.array(found.status, type=pyarrow.string()))
        return type(batch).from_arrays(arrays, names=names)
