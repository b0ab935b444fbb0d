"""Opens a run's XDMF sidecar and VTKHDF exports with VTK as time series.

    python tools/open_in_vtk.py RUN.h5 [RUN.xdmf] [CLOUD.vtkhdf ...]

Compares times, point counts, positions and fields of every frame with what
h5py reads from RUN.h5, and exits with 1 when anything differs.
"""

import pathlib
import sys

import h5py
import numpy as np
import vtk
from read_hdf5 import clouds, frames
from vtk.util.numpy_support import vtk_to_numpy

FAILURES = []


def check(condition, message):
    if not condition:
        FAILURES.append(message)
        print("FAILED", message)


def times_of(algorithm):
    algorithm.UpdateInformation()
    information = algorithm.GetOutputInformation(0)
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return [information.Get(key, i) for i in range(information.Length(key))]


def compare(points, data, cloud, label):
    """One point set of VTK against one cloud of the HDF5 file."""
    position = cloud["position"][:]
    check(len(points) == len(position), f"{label}: {len(points)} points for {len(position)}")
    if len(points) != len(position):
        return
    check(np.allclose(points, position, rtol=1e-6, atol=1e-6), f"{label}: positions differ")
    for field in cloud.attrs["fields"]:
        stored = cloud[field][:]
        arrays = [data.GetArray(name) for name in array_names(field, stored, data)]
        complete = all(array is not None for array in arrays)
        check(complete, f"{label}: no field {field}")
        if complete:
            read = np.column_stack([vtk_to_numpy(array) for array in arrays])
            same = np.allclose(read.reshape(stored.shape), stored, rtol=1e-5)
            check(same, f"{label}: field {field} differs")


def array_names(field, stored, data):
    """The sidecar splits symmetric tensors into six scalars."""
    if data.GetArray(field) is None and stored.ndim == 2 and stored.shape[1] == 6:
        return [f"{field}_{component}" for component in ("xx", "yy", "zz", "xy", "yz", "xz")]
    return [field]


def leaves(data):
    """The named point sets of a nested data set."""
    if isinstance(data, vtk.vtkMultiBlockDataSet):
        for i in range(data.GetNumberOfBlocks()):
            block = data.GetBlock(i)
            meta = data.GetMetaData(i) if data.HasMetaData(i) else None
            name = meta.Get(vtk.vtkCompositeDataSet.NAME()) if meta else ""
            for leaf_name, leaf in leaves(block):
                yield leaf_name or name, leaf
    elif data is not None:
        yield "", data


def check_xdmf(path, file):
    expected = list(frames(file))
    # ParaView has a second reader of this format; the Python wheels have one.
    kinds = [getattr(vtk, name, None) for name in ("vtkXdmfReader", "vtkXdmf3Reader")]
    check(any(kinds), "this VTK has no XDMF reader")
    for kind in filter(None, kinds):
        reader = kind()
        reader.SetFileName(str(path))
        times = times_of(reader)
        label = f"{path.name} with {kind.__name__}"
        stored = [frame.attrs["time"] for frame in expected]
        check(np.array_equal(times, stored), f"{label}: times {times} for {stored}")
        for time, frame in zip(times, expected):
            reader.UpdateTimeStep(time)
            blocks = leaves(reader.GetOutputDataObject(0))
            # VTK numbers grids of the same name: fluid[1], fluid[2], …
            found = {name.split("[")[0]: leaf for name, leaf in blocks}
            wanted = dict(clouds(frame)) | dict(clouds(file["static"]))
            wanted = {name: cloud for name, cloud in wanted.items() if len(cloud["position"])}
            check(set(found) == set(wanted), f"{label}: {set(found)} for {set(wanted)}")
            for name in set(found) & set(wanted):
                points = vtk_to_numpy(found[name].GetPoints().GetData())
                compare(points, found[name].GetPointData(), wanted[name], f"{label} t={time} {name}")
        print(f"{label}: {len(times)} times, {sum(map(len, [found]))} clouds at the last")


def check_vtkhdf(path, file):
    reader = vtk.vtkHDFReader()
    reader.SetFileName(str(path))
    times = times_of(reader)
    names = [name for frame in frames(file) for name, _ in clouds(frame)]
    names += [name for name, _ in clouds(file["static"])]
    name = next(name for name in names if name.replace("/", "_") == path.stem)
    series = {frame.attrs["time"]: frame[name] for frame in frames(file) if name in frame}
    series = series or {0.0: file["static"][name]}
    check(list(times) == list(series) or not times, f"{path.name}: times {times}")
    for time in times or [0.0]:
        reader.UpdateTimeStep(time)
        data = reader.GetOutputDataObject(0)
        points = vtk_to_numpy(data.GetPoints().GetData())
        compare(points, data.GetPointData(), series[time], f"{path.name} t={time}")
        check(data.GetNumberOfVerts() == len(points), f"{path.name} t={time}: vertex cells")
    print(f"{path.name}: {len(times)} times, {len(points)} points at the last")


def main(run, others):
    with h5py.File(run, "r", locking=False) as file:
        for path in map(pathlib.Path, others or [pathlib.Path(run).with_suffix(".xdmf")]):
            (check_xdmf if path.suffix == ".xdmf" else check_vtkhdf)(path, file)
    print(f"{len(FAILURES)} failures")
    sys.exit(bool(FAILURES))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
