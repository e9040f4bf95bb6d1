"""The batch function on engines that exist: results are those of one process, bit for bit. An engine that is not installed
is said to have been left out."""

import os
import pickle
import shutil
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest
from test_mechanism import four_bar

import kin

NAMES = ["C.u_i.x", "B.u_i.x"]
TIMES = np.linspace(0, 1, 61)
KEEP = ["rocker.theta max", "rocker.theta min", ("A.angle", "range")]


def batch():
    return kin.Batch.of(four_bar().build(), NAMES, TIMES, KEEP)


def cases(n=600):
    random = np.random.default_rng(11)
    return np.stack([random.uniform(3.3, 5.5, n), random.uniform(1.2, 1.9, n)], axis=1)


@pytest.fixture(scope="module")
def alone():
    """One process: every case in one call."""
    rows = batch().rows(cases())
    assert rows.ok.sum() > 400 and (~rows.ok).sum() > 5
    return rows


def same(values, status, alone):
    np.testing.assert_array_equal(np.asarray(values, dtype=float), alone.values)
    assert list(status) == alone.status


def part(rows):
    """A part of the cases, in a process of its own."""
    found = batch().rows(rows)
    return found.values, found.status


def test_parts_of_any_size_give_the_same_digits(alone):
    for n in (1, 7, 250):
        parts = [batch().rows(cases()[k : k + n]) for k in range(0, 600, n)]
        same(np.concatenate([one.values for one in parts]), sum((one.status for one in parts), []), alone)


def test_threads_give_the_same_digits(alone):
    found = kin.Batch.of(four_bar().build(), NAMES, TIMES, KEEP, threads=None).rows(cases())
    same(found.values, found.status, alone)


def test_the_function_pickles(alone):
    found = pickle.loads(pickle.dumps(batch()))({"C.u_i.x": cases()[:, 0], "B.u_i.x": cases()[:, 1], "id": range(600)})
    assert list(found["id"]) == list(range(600))
    same(np.stack([found[name] for name in alone.names], axis=1), found["status"], alone)


def test_concurrent_futures(alone):
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        parts = list(pool.map(part, np.array_split(cases(), 5)))
    same(np.concatenate([values for values, _ in parts]), sum((status for _, status in parts), []), alone)


def frame():
    pandas = pytest.importorskip("pandas", reason="NOT RUN: pandas is not installed")
    return pandas.DataFrame({"id": range(600), "C.u_i.x": cases()[:, 0], "B.u_i.x": cases()[:, 1]})


def test_pandas(alone):
    found = batch().pandas(frame())
    same(found[alone.names].to_numpy(), found["status"], alone)


def test_arrow(alone):
    pyarrow = pytest.importorskip("pyarrow", reason="NOT RUN: pyarrow is not installed")
    table = pyarrow.Table.from_pandas(frame(), preserve_index=False)
    parts = [batch().arrow(one) for one in table.to_batches(max_chunksize=128)]
    found = pyarrow.Table.from_batches(parts)
    same(found.select(alone.names).to_pandas().to_numpy(), found["status"].to_pylist(), alone)


def test_dask(alone):
    dask = pytest.importorskip("dask.dataframe", reason="NOT RUN: Dask is not installed")
    meta = batch().pandas(frame()[:0])
    parted = dask.from_pandas(frame(), npartitions=7)
    found = parted.map_partitions(batch().pandas, meta=meta).compute(scheduler="processes", num_workers=2)
    found = found.sort_values("id")
    same(found[alone.names].to_numpy(), found["status"], alone)


def test_ray(alone, tmp_path_factory):
    ray = pytest.importorskip("ray", reason="NOT RUN: Ray is not installed")
    pytest.importorskip("ray.data", reason="NOT RUN: Ray's data is not installed")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        data = ray.data.from_pandas(frame())
        found = data.map_batches(batch(), batch_size=100, batch_format="numpy").to_pandas().sort_values("id")
        same(found[alone.names].to_numpy(), found["status"], alone)
    finally:
        ray.shutdown()


def test_spark(alone):
    pytest.importorskip("pyspark", reason="NOT RUN: Spark is not installed")
    pytest.importorskip("pyarrow", reason="NOT RUN: pyarrow is not installed")
    if shutil.which("java") is None:
        pytest.skip("NOT RUN: Spark needs Java")
    from pyspark.sql import SparkSession

    os.environ.setdefault("SPARK_LOCAL_IP", "127.0.0.1")
    os.environ["PYSPARK_PYTHON"] = os.environ["PYSPARK_DRIVER_PYTHON"] = sys.executable
    spark = SparkSession.builder.master("local[2]").config("spark.ui.enabled", "false").getOrCreate()
    try:
        run = batch()
        given = spark.createDataFrame(frame().rename(columns={"C.u_i.x": "c", "B.u_i.x": "b"}).to_dict("records"))
        schema = "id long, b double, c double, rocker_max double, rocker_min double, a_range double, status string"

        def mapped(batches):
            import pyarrow

            for one in batches:
                found = run.arrow(one.rename_columns(["B.u_i.x", "C.u_i.x", "id"]))
                order = ["id", "B.u_i.x", "C.u_i.x", *(f"{name} {what}" for name, what in wanted), "status"]
                columns = [found.column(found.schema.get_field_index(name)) for name in order]
                names = ["id", "b", "c", "rocker_max", "rocker_min", "a_range", "status"]
                yield pyarrow.RecordBatch.from_arrays(columns, names=names)

        wanted = [("rocker.theta", "max"), ("rocker.theta", "min"), ("A.angle", "range")]
        found = given.repartition(5).mapInArrow(mapped, schema).toPandas().sort_values("id")
        same(found[["rocker_max", "rocker_min", "a_range"]].to_numpy(), found["status"], alone)
    finally:
        spark.stop()
