"""h5md.py RUN.h5 RUN.csv: checks that an H5MD trajectory has bit for bit the contents of the CSV of the same run.
h5md.py --frames RUN.h5: prints the number of frames.
h5md.py --same RUN.h5 OTHER.h5: checks that both files have the same contents."""

import csv
import math
import sys

import h5py
import numpy


def rows_of(group):
    """Returns a mapping from the frame number to the row, for each frame that contains the group."""
    return {int(step): row for row, step in enumerate(group["position/step"])}


def check_dimensions(data, *names):
    """Checks that the dimensions of a data set have names, as xarray and ncdump show them, and positions."""
    for dimension, (scales, name) in enumerate(zip(data.dims, names)):
        assert list(scales) == [name], (data, name)
        scale = scales[0]
        assert h5py.h5ds.is_scale(scale.id) and scale.shape == (data.shape[dimension],)
        assert name == "time" or list(scale) == list(range(len(scale)))
        assert [int(number) for used, number in scale.attrs["REFERENCE_LIST"] if data.file[used] == data] == [dimension]


def check_form(file):
    about = file["h5md"]
    assert list(about.attrs["version"]) == [1, 1]
    assert about["creator"].attrs["name"] == b"petri" and about["author"].attrs["name"]
    for group in file["particles"].values():
        frames = len(group["position/step"])
        dimensions = group["box"].attrs["dimension"]
        assert list(group["box"].attrs["boundary"]) == [b"none"] * dimensions
        assert group["box/edges/value"].shape == (frames, dimensions)
        shape = group["position/value"].shape
        assert shape[0] == frames and shape[2] == dimensions
        for name in "position", "velocity", "radius", "mass", "charge", "id", "anchor":
            element = group[name]
            assert element["step"] == group["position/step"] and element["time"] == group["position/time"]
            assert element["value"].shape == (shape if name in ("position", "velocity") else shape[:2])
            assert element["value"].dtype == ("<i8" if name in ("id", "anchor") else "<f8")
            check_dimensions(element["value"], "time", "particle", "axis")
        check_dimensions(group["position/step"], "time")
        check_dimensions(group["species"], "particle")
        check_dimensions(group["box/edges/value"], "time", "axis")
        assert group["id/value"].fillvalue == -1
        assert group["species"].shape == shape[1:2] and not group["species"][:].any()


def compare(path, table):
    with h5py.File(path) as file:
        check_form(file)
        groups = {group.attrs["system"].decode(): group for group in file["particles"].values()}
        texts = [text.decode() for text in file["parameters/id_texts"]] if "parameters" in file else []
        data = {
            name: {column: group[column]["value"][:] for column in group if column not in ("box", "species", "particle", "axis")}
            for name, group in groups.items()
        }
        rows = {name: rows_of(group) for name, group in groups.items()}
        times = {name: group["position/time"][:] for name, group in groups.items()}
        edges = {name: group["box/edges/value"][:] for name, group in groups.items()}
    seen = {}
    with open(table, newline="") as lines:
        for line in csv.DictReader(lines):
            name, frame = line["system"], int(line["frame"])
            row = rows[name][frame]
            place = seen.get((name, row), 0)
            seen[name, row] = place + 1
            columns = {column: values[row, place] for column, values in data[name].items()}
            number = int(columns["id"])
            assert (str(number) if number >= 0 else texts[-2 - number]) == line["id"], line
            for key in "radius", "mass", "charge", "anchor":
                assert float(line[key]) == columns[key], (key, line)
            for letter, column in ("x", "position"), ("v", "velocity"):
                for k, value in enumerate(columns[column]):
                    assert float(line[f"{letter}{k + 1}"]) == value, (column, line)
            assert float(line["time"]) == times[name][row]
    filled = 0
    for name, columns in data.items():
        for row in rows[name].values():
            count = seen.get((name, row), 0)
            assert (columns["id"][row, count:] == -1).all()
            assert numpy.isnan(columns["position"][row, count:]).all()
            filled += columns["id"].shape[1] - count
            inside = columns["position"][row, :count]
            extent = inside.max(axis=0) - inside.min(axis=0) if count else 0
            assert (edges[name][row] == extent).all()
    assert sum(seen.values()) > 0
    print(len(groups), "systems,", sum(seen.values()), "particles,", filled, "absent,", len(texts), "texts")


def frames(path):
    with h5py.File(path) as file:
        check_form(file)
        (group,) = file["particles"].values()
        count = len(group["position/step"])
        assert list(group["position/step"]) == list(range(count))
        assert not math.isnan(group["position/value"][count - 1].sum())
        print(count)


def contents(path):
    """Returns all attributes of a file, and the bytes of its arrays."""
    found = {}

    def visit(name, item):
        found[name] = {key: numpy.array(value).tolist() for key, value in item.attrs.items() if not key.endswith("_LIST")}
        if isinstance(item, h5py.Dataset):
            found[name]["dimensions"] = [list(scales) for scales in item.dims]
            found[name]["value of"] = item.shape, item.dtype.str, item.maxshape, item[...].tobytes()
        else:
            for key, member in item.items():
                visit(f"{name}/{key}", member)

    with h5py.File(path) as file:
        check_form(file)
        visit("", file)
    return found


if sys.argv[1] == "--frames":
    frames(sys.argv[2])
elif sys.argv[1] == "--same":
    one, other = map(contents, sys.argv[2:])
    assert one.keys() == other.keys(), one.keys() ^ other.keys()
    assert not [name for name in one if one[name] != other[name]], [name for name in one if one[name] != other[name]]
else:
    compare(*sys.argv[1:])
