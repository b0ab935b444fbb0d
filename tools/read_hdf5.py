"""Reads a run's HDF5 file with h5py: the example for your own scripts.

    python tools/read_hdf5.py RUN.h5

Prints the header, the frames with their point counts and extreme values, and
the largest value of every gauge. Works while the run is still writing.
"""

import sys

import h5py
import numpy as np


def clouds(group):
    """Yields (name, group) of every point cloud of a frame or of /static."""
    for name in group.attrs["clouds"]:
        yield name, group[name]


def frames(file):
    """Yields every frame's group in order of time."""
    for bucket in sorted(file["frames"]):
        for frame in sorted(file["frames"][bucket]):
            yield file["frames"][bucket][frame]


def history(file, table):
    """Returns time (s) and {column: (values, unit)} of `gauges` or `ledger`."""
    group = file["history"][table]
    # A kill may leave columns of unequal length: the shortest counts.
    rows = min(len(dataset) for dataset in group.values())
    columns = {
        name: (group[name][:rows], group[name].attrs["units"])
        for name in group.attrs["columns"]
    }
    return group["time"][:rows], columns


def main(path):
    # The writer holds a lock; reading without one is safe, see docs.
    with h5py.File(path, "r", locking=False) as file:
        attributes = file.attrs
        print(f"case {attributes['case_name']}, {attributes['dimension']}D,", end=" ")
        print(f"written by fsi-runner {attributes['program_version']}")
        print(f"overrides: {list(attributes['overrides'])}")
        for name, cloud in clouds(file["static"]):
            print(f"static {name}: {len(cloud['position'])} points")
        for frame in frames(file):
            print(f"frame {frame.attrs['index']}: t = {frame.attrs['time']:.6g} s,", end=" ")
            print(f"step {frame.attrs['step']}")
            for name, cloud in clouds(frame):
                print(f"  {name}: {len(cloud['position'])} points")
                for field in cloud.attrs["fields"]:
                    values = cloud[field][:]
                    if len(values) == 0:
                        continue
                    low, high = np.nanmin(values), np.nanmax(values)
                    print(f"    {field}: {low:.6g} to {high:.6g} {cloud[field].attrs['units']}")
        for table in ("gauges", "ledger"):
            time, columns = history(file, table)
            print(f"{table}: {len(time)} rows")
            for name, (values, unit) in columns.items():
                if np.isfinite(values).any():
                    at = np.nanargmax(np.abs(values))
                    print(f"  {name}: largest {values[at]:.6g} {unit} at t = {time[at]:.6g} s")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
