#!/usr/bin/env python3
"""Check the frames of a run with VTK's own reader.

    check-frames.py FOLDER [--allow-removed] [--require NAME]... [--expect CHECK]...

Reads particles.pvd in FOLDER and every frame that it lists, and checks that
- times increase strictly and equal the TimeValue in the frame;
- every frame has the same number of points (with --allow-removed: never more than before) and the same arrays;
- arrays with a known name have the known number of components, ids are whole, none is there twice;
- every value is finite;
- every particle is a vertex cell;
- the centre of mass and the mass of each body equal those in history.csv at the same time, where the frames have
  Mass and Body Id.

Where there is a grid.pvd, its frames of nodes are checked the same way, but that nodes have no ids and their number
changes, and that a Contact Gap is no number where no partner is near. The masses and contact forces of the nodes add up
to those in history.csv: those of a Body Id to the body with a field of its own, those without one to all others.

CHECK is NAME:ID:COMPONENT[@TIME]=VALUE+-TOLERANCE (or ±), for the particle with that Particle Id, in the last
frame or in the one at TIME; components count from 0; NAME "Points" means the position. Example:
--expect 'Velocity:7:2@0.1=-0.981+-1e-9'

Exit code: 0 all well, 1 a check failed, 2 bad usage, no frames to check, or VTK missing.
"""

import argparse
import csv
import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

EXIT_FAILED = 1
EXIT_USAGE = 2

VECTORS = {"Displacement", "Velocity", "Acceleration", "Momentum", "Contact Force"}
WHOLE = {"Particle Id", "Material Id", "Body Id"}
SCALARS = {"Mass", "Density", "Volume", "Pressure", "Contact Gap"}
MAY_BE_NO_NUMBER = {"Contact Gap"}
# Body Id of a node whose field is that of all bodies without one of their own.
COMMON_FIELD = -(2**63)
TENSORS = {"Stress", "Strain"}
TENSOR_COMPONENTS = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"]
# The sums of a body are formed in another order here than in the run: n * eps for a million particles.
SUM_TOLERANCE = 1e-9


def main():
    arguments = parse_arguments()
    modules = import_vtk()
    folder = arguments.folder
    listed, frames, problems = read_frames(modules, folder, "particles.pvd")
    for file, time, frame in frames:
        problems += [f"{file}: {text}" for text in check_frame(frame, time, ["Particle Id", *arguments.require])]
    problems += check_series(listed, frames, arguments.allow_removed)
    problems += [text for check in arguments.expect for text in check_expected(check, frames)]
    history, wrong = read_history(folder / "history.csv")
    problems += wrong
    compared, differing = check_history(history, frames)
    problems += differing
    print_table(frames)
    print(f"{len(listed)} frames listed, {len(frames)} read with VTK {modules['version']}")
    print(f"{len(arguments.expect)} expected values, {compared} body states compared with history.csv")
    if (folder / "grid.pvd").is_file():
        listed, frames, wrong = read_frames(modules, folder, "grid.pvd")
        problems += wrong
        for file, time, frame in frames:
            problems += [f"{file}: {text}" for text in check_frame(frame, time, [])]
        problems += check_times(listed)
        compared, differing = check_nodes(history, frames)
        problems += differing
        print_table(frames)
        print(f"{len(listed)} frames of nodes listed, {len(frames)} read, {compared} sums compared with history.csv")
    for text in problems:
        print(f"FAILED  {text}")
    print(f"{len(problems)} problems" if problems else "all well")
    return EXIT_FAILED if problems else 0


def read_frames(modules, folder, name):
    """What a list of frames holds, the frames that could be read with their times, and what was wrong with others."""
    listed, frames, problems = read_list(folder / name), [], []
    for file, time in listed:
        frame, error = read_frame(modules, folder / file)
        if error:
            problems.append(f"{file}: {error}")
        else:
            frames.append((file, time, frame))
    return listed, frames, problems


def parse_arguments():
    summary, details = __doc__.split("\n", 1)
    parser = argparse.ArgumentParser(
        description=summary, epilog=details, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="output folder of a run")
    parser.add_argument("--allow-removed", action="store_true", help="particles may leave between frames")
    parser.add_argument("--require", action="append", default=[], metavar="NAME", help="array that must be there")
    parser.add_argument("--expect", action="append", default=[], type=expectation, metavar="CHECK")
    return parser.parse_args()


def expectation(text):
    """NAME:ID:COMPONENT[@TIME]=VALUE+-TOLERANCE as a dictionary."""
    number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    match = re.fullmatch(
        rf"(?P<name>.+):(?P<id>\d+):(?P<component>\d+)(?:@(?P<time>{number}))?"
        rf"=(?P<value>{number})(?:\+-|±)(?P<tolerance>{number})",
        text,
    )
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is not NAME:ID:COMPONENT[@TIME]=VALUE+-TOLERANCE")
    fields = match.groupdict()
    return {
        "text": text,
        "name": fields["name"],
        "id": int(fields["id"]),
        "component": int(fields["component"]),
        "time": None if fields["time"] is None else float(fields["time"]),
        "value": float(fields["value"]),
        "tolerance": float(fields["tolerance"]),
    }


def leave(message):
    print(f"check-frames: {message}", file=sys.stderr)
    sys.exit(EXIT_USAGE)


def import_vtk():
    try:
        import numpy
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkVersion
        from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader
    except ImportError as error:
        leave(f"needs Python's vtk package with numpy ({error}); install it with: pip install vtk numpy")
    return {
        "numpy": numpy,
        "to_numpy": vtk_to_numpy,
        "reader": vtkXMLUnstructuredGridReader,
        "reader of pieces": vtkXMLPUnstructuredGridReader,
        "version": vtkVersion.GetVTKVersion(),
    }


def read_list(path):
    """File name and time of every frame."""
    try:
        root = ElementTree.parse(path).getroot()
        listed = [(entry.attrib["file"], float(entry.attrib["timestep"])) for entry in root.iter("DataSet")]
    except OSError as error:
        leave(f"cannot read {path}: {error.strerror}")
    except (ElementTree.ParseError, KeyError, ValueError) as error:
        leave(f"{path} is no list of frames: {error}")
    if not listed:
        leave(f"{path} lists no frames: nothing was checked")
    return listed


def read_frame(modules, path):
    """What VTK makes of the file, as numpy arrays; or the reason why it makes nothing of it."""
    if not path.is_file():
        return None, "listed, but not there"
    reader = modules["reader of pieces" if path.suffix == ".pvtu" else "reader"]()
    errors = []
    # VTK reports a bad file as an event of the reader or of the XML parser in it, and goes on with an empty grid.
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("VTK reports an error"))
    reader.AddObserver("WarningEvent", lambda *_: errors.append("VTK reports a warning"))
    reader.SetFileName(str(path))
    reader.Update()
    if errors or reader.GetErrorCode():
        return None, errors[0] if errors else f"VTK error code {reader.GetErrorCode()}"
    grid = reader.GetOutput()
    to_numpy, numpy = modules["to_numpy"], modules["numpy"]
    count = grid.GetNumberOfPoints()
    data = grid.GetPointData()
    arrays = {}
    for index in range(data.GetNumberOfArrays()):
        array = data.GetArray(index)
        if array is None:
            return None, f"point array {index} holds no numbers"
        values = to_numpy(array).reshape(array.GetNumberOfTuples(), array.GetNumberOfComponents())
        arrays[array.GetName()] = values
    field = grid.GetFieldData().GetArray("TimeValue")
    points = to_numpy(grid.GetPoints().GetData()) if count else numpy.zeros((0, 3))
    return {
        "points": points,
        "arrays": arrays,
        "time": None if field is None else field.GetValue(0),
        "vertices": vertex_points(grid, to_numpy, numpy),
        "numpy": numpy,
    }, None


def vertex_points(grid, to_numpy, numpy):
    """The point of every cell, or nothing if some cell is no vertex (VTK's cell type 1)."""
    if not grid.GetNumberOfCells():
        return numpy.zeros(0, dtype=int)
    types = grid.GetDistinctCellTypesArray()
    if [types.GetValue(i) for i in range(types.GetNumberOfTuples())] != [1]:
        return None
    return to_numpy(grid.GetCells().GetConnectivityArray())


def check_frame(frame, time, required):
    numpy = frame["numpy"]
    count = len(frame["points"])
    arrays = frame["arrays"]
    if frame["time"] is None:
        yield "no TimeValue"
    elif frame["time"] != time:
        yield f"TimeValue {frame['time']!r}, listed as {time!r}"
    if frame["vertices"] is None or not numpy.array_equal(frame["vertices"], numpy.arange(count)):
        yield "the cells are not one vertex per point, in their order"
    for name in required:
        if name not in arrays:
            yield f"no array {name!r}"
    if not numpy.isfinite(frame["points"]).all():
        yield "a position is not finite"
    for name, values in arrays.items():
        components = known_components(name)
        if len(values) != count:
            yield f"{name}: {len(values)} values for {count} points"
        if components is not None and values.shape[1] != components:
            yield f"{name}: {values.shape[1]} components, expected {components}"
        if name in WHOLE and not numpy.issubdtype(values.dtype, numpy.integer):
            yield f"{name}: {values.dtype}, expected whole numbers"
        allowed = numpy.isnan(values) if name in MAY_BE_NO_NUMBER else False
        bad = numpy.flatnonzero(~(numpy.isfinite(values) | allowed).all(axis=1))
        if len(bad):
            yield f"{name}: not finite at {len(bad)} points, first at index {bad[0]}"
    for tensor in TENSORS:
        missing = [c for c in TENSOR_COMPONENTS if f"{tensor}_{c}" not in arrays]
        if missing and len(missing) < len(TENSOR_COMPONENTS):
            yield f"{tensor}: components {', '.join(missing)} are missing"
    ids = arrays.get("Particle Id")
    if ids is not None and len(numpy.unique(ids)) != len(ids):
        yield "Particle Id: an id is there twice"


def known_components(name):
    if name in VECTORS:
        return 3
    if name in WHOLE | SCALARS or name.partition("_")[2] in TENSOR_COMPONENTS:
        return 1
    return None


def check_times(listed):
    for (_, before), (file, time) in zip(listed, listed[1:]):
        if not time > before:
            yield f"{file}: time {time!r} is not later than {before!r}"


def check_series(listed, frames, allow_removed):
    yield from check_times(listed)
    for (_, _, before), (file, _, frame) in zip(frames, frames[1:]):
        old, new = len(before["points"]), len(frame["points"])
        if new > old or (new < old and not allow_removed):
            yield f"{file}: {new} points, {old} in the frame before"
        if set(frame["arrays"]) != set(before["arrays"]) and min(old, new) > 0:
            changed = sorted(set(frame["arrays"]) ^ set(before["arrays"]))
            yield f"{file}: arrays {', '.join(changed)} are not in both this frame and the one before"
        ids, earlier = frame["arrays"].get("Particle Id"), before["arrays"].get("Particle Id")
        if ids is not None and earlier is not None and not set(ids.flat) <= set(earlier.flat):
            yield f"{file}: a Particle Id that the frame before does not have"


def check_expected(check, frames):
    chosen = [(file, frame) for file, time, frame in frames if check["time"] in (None, time)]
    if not chosen:
        yield f"{check['text']}: no frame at this time"
        return
    file, frame = chosen[-1]
    values = frame["points"] if check["name"] == "Points" else frame["arrays"].get(check["name"])
    ids = frame["arrays"].get("Particle Id")
    if values is None or ids is None:
        yield f"{check['text']}: {file} has no such array"
        return
    rows = frame["numpy"].flatnonzero(ids[:, 0] == check["id"])
    if not len(rows) or check["component"] >= values.shape[1]:
        yield f"{check['text']}: {file} has no such particle or component"
        return
    found = float(values[rows[0], check["component"]])
    if not abs(found - check["value"]) <= check["tolerance"]:
        yield f"{check['text']}: {file} has {found!r}"


def read_history(path):
    """The rows of history.csv by their time, and what is wrong with it."""
    if not path.is_file():
        return {}, []
    with path.open(newline="", encoding="utf-8") as file:
        try:
            return {float(row["time"]): row for row in csv.DictReader(file)}, []
        except (KeyError, TypeError, ValueError) as error:
            return {}, [f"history.csv: {error!r}"]


def check_nodes(rows, frames):
    """Number of sums over nodes compared, and what differs."""
    compared, problems = 0, []
    for file, time, frame in frames:
        arrays, row, numpy = frame["arrays"], rows.get(time), frame["numpy"]
        if "Body Id" not in arrays or row is None:
            continue
        fields = arrays["Body Id"][:, 0]
        own = {f"body{field}" for field in numpy.unique(fields) if field != COMMON_FIELD}
        bodies = {column.split("_")[0] for column in row if re.fullmatch(r"body-?\d+_mass", column)}
        wanted = [("mass", "Mass", 0)] + [(f"contact_f{axis}", "Contact Force", i) for i, axis in enumerate("xyz")]
        for name, array, component in wanted:
            if array not in arrays:
                continue
            values = arrays[array][:, component]
            scale = float(numpy.abs(arrays[array]).sum())
            sums = [(body, values[fields == int(body[4:])].sum(), [body]) for body in sorted(own & bodies)]
            sums.append(("the common field", values[fields == COMMON_FIELD].sum(), sorted(bodies - own)))
            for label, found, of in sums:
                known = [row.get(f"{body}_{name}") for body in of]
                if not known or not all(known):
                    continue
                expected = sum(float(value) for value in known)
                compared += 1
                if not math.isclose(found, expected, rel_tol=0, abs_tol=SUM_TOLERANCE * scale):
                    problems.append(f"{file}: {name} of {label} is {found!r} in the frame, {expected!r} in history.csv")
    return compared, problems


def check_history(rows, frames):
    """Number of body states compared, and what differs."""
    compared, problems = 0, []
    for file, time, frame in frames:
        masses, bodies = frame["arrays"].get("Mass"), frame["arrays"].get("Body Id")
        row = rows.get(time)
        if masses is None or bodies is None or row is None:
            continue
        points, numpy = frame["points"], frame["numpy"]
        for body in numpy.unique(bodies):
            mask = bodies[:, 0] == body
            mass = masses[mask, 0]
            centre = (mass[:, None] * points[mask]).sum(axis=0) / mass.sum()
            scale = max(1e-300, float(numpy.abs(points).max()))
            states = [("mass", mass.sum(), mass.sum())]
            states += [(axis, centre[i], scale) for i, axis in enumerate("xyz")]
            known = False
            for name, found, size in states:
                column = f"body{body}_{name}"
                if not row.get(column):
                    continue
                known = True
                if not math.isclose(found, float(row[column]), rel_tol=0, abs_tol=SUM_TOLERANCE * size):
                    problems.append(f"{file}: {column} is {found!r} in the frame, {row[column]} in history.csv")
            compared += known
    return compared, problems


def print_table(frames):
    print(f"{'frame':24} {'time [s]':>24} {'points':>9} {'arrays':>6}  largest |velocity|, |displacement|")
    for file, time, frame in frames:
        numpy = frame["numpy"]
        largest = []
        for name in ["Velocity", "Displacement"]:
            values = frame["arrays"].get(name)
            norm = None if values is None or not len(values) else numpy.linalg.norm(values, axis=1).max()
            largest.append("-" if norm is None else f"{norm:.6g}")
        print(f"{file:24} {time!r:>24} {len(frame['points']):>9} {len(frame['arrays']):>6}  {', '.join(largest)}")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BrokenPipeError:
        sys.exit(0)
