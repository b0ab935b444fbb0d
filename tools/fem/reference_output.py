"""Where the references go and how they are written: a comment line, a header, rows."""
import csv
import os
import numpy as np

OUT = os.environ.get('REFERENCE_OUT', 'reference')
STRESSES = ['s_xx', 's_yy', 's_zz', 's_xy', 's_yz', 's_xz']


def write_csv(case, name, comment, head, rows, number='%.7g'):
    folder = os.path.join(OUT, case)
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name), 'w', newline='') as file:
        file.write('# ' + comment + '\n')
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(head)
        writer.writerows([v if isinstance(v, (str, int)) else number % v for v in row] for row in rows)


def full_block(octant):
    """Six stresses on an octant's cells (component, x, y, z) mirrored to the whole block, z from the fixed end."""
    for axis, odd in ((3, (4, 5)), (1, (3, 5)), (2, (3, 4))):
        mirrored = np.flip(octant, axis).copy()
        mirrored[list(odd)] *= -1
        octant = np.concatenate([mirrored, octant], axis=axis)
    return octant


def cell_rows(stress, size):
    """Rows i, j, k, cell centre, six stresses of a whole block's cells of edge `size`."""
    return [(*ijk, *((n + 0.5) * size for n in ijk), *stress[(slice(None), *ijk)]) for ijk in np.ndindex(stress.shape[1:])]
