"""The block between rough plates (block_common.py) shortened by 1 % with finite strain: 1 x 1 x 2 m, E 30 GPa, nu 0.2, top moved by 0.02 m.
usage: block_finite_strain.py LAW ELEM N_PER_CELL [GRADED_LEVELS]   (LAW = neo_hookean|st_venant, ELEM = hex1|hex1mid|hex2)
hex1mid at 1 and 2 elements a cell is the static limit of total-Lagrangian uGIMP on the grids of 0.1 and 0.05 (points at +-h/4).
Stresses are Cauchy, divided by E eps0 (eps0 = 0.01), averaged over cells of the undeformed block: over the cell's reference volume
(mean) and over its 8 points at +-h/4 (points).  Writes results/block_1pct_<...>.npz and appends to results/block_1pct_summary.csv;
`block_finite_strain.py export` writes the CSVs and prints the comparison.
"""
import csv
import os
import sys
import time
import numpy as np
from skfem import Basis, ElementHex1, ElementHex2, MeshHex
from block_common import H, LX, LY, LZ, octant_axes
from hyperelastic import NeoHookeanLog, Solid, StVenantKirchhoff, lame
from reference_output import STRESSES, cell_rows, full_block, write_csv

YOUNG, POISSON, STRAIN = 30e9, 0.2, 0.01
LAWS = {'neo_hookean': NeoHookeanLog, 'st_venant': StVenantKirchhoff}
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
REFERENCE = ('hex2', 2, 6)


def solve(law, elem, n, levels):
    axes = octant_axes(n, levels)
    rule = {'intorder': 5 if elem == 'hex2' else 3}
    if elem == 'hex1mid':
        q = np.array([0.25, 0.75])
        rule = {'quadrature': (np.array(np.meshgrid(q, q, q, indexing='ij')).reshape(3, -1), np.full(8, 0.125))}
    solid = Solid(Basis(MeshHex.init_tensor(*axes), ElementHex2() if elem == 'hex2' else ElementHex1(), **rule), LAWS[law](*lame(YOUNG, POISSON)))
    x = solid.position
    top = x[2] > LZ / 2 - 1e-9
    held = [np.flatnonzero((x[i] < 1e-9) | top) for i in range(3)]
    u = np.zeros((x.shape[1], 3))
    u[:, 2] = -STRAIN * x[2]
    u, force = solid.solve(u.ravel(), np.concatenate([3 * nodes + i for i, nodes in enumerate(held)]), report=True)
    reaction = -4 * force[3 * np.flatnonzero(top) + 2].sum() / (YOUNG * STRAIN * LX * LY)
    return solid, u, reaction, axes


def cell_index(points, size):
    shape = [round(length / 2 / size) for length in (LX, LY, LZ)]
    return np.ravel_multi_index([np.minimum((p / size + 1e-7).astype(int), s - 1) for p, s in zip(points, shape)], shape), shape


def volume_average(solid, u, size):
    """Cell averages weighted with the reference volume."""
    flat, shape = cell_index(solid.basis.mesh.p[:, solid.basis.mesh.t].mean(axis=1), size)
    total, volume = np.zeros((6, np.prod(shape))), np.bincount(flat, solid.weight.sum(1))
    for start in range(0, len(flat), 500):
        part = slice(start, start + 500)
        s = solid.cauchy(u, part)
        for row, (i, j) in zip(total, PAIRS):
            row += np.bincount(flat[part], (s[..., i, j] * solid.weight[part]).sum(1), len(row))
    return (total / volume / (YOUNG * STRAIN)).reshape(6, *shape)


def point_average(solid, u, axes, size):
    """Mean of the 8 points at +-size/4; a point on an element face takes the mean of both sides."""
    basis, mesh = solid.basis, solid.basis.mesh
    c = mesh.p[:, mesh.t].mean(axis=1)
    table = np.zeros([len(a) - 1 for a in axes], int)
    table[tuple(np.searchsorted(a, v) - 1 for a, v in zip(axes, c))] = np.arange(mesh.nelements)
    lines = [np.concatenate([q + s for s in (-1e-7, 1e-7)]) for q in (np.arange(0.25 * size, length / 2, 0.5 * size) for length in (LX, LY, LZ))]
    points = np.array(np.meshgrid(*lines, indexing='ij')).reshape(3, -1)
    flat, shape = cell_index(points, size)
    total, count = np.zeros((6, np.prod(shape))), np.bincount(flat)
    for start in range(0, points.shape[1], 20000):
        part = slice(start, start + 20000)
        p = points[:, part]
        element = table[tuple(np.searchsorted(a, v) - 1 for a, v in zip(axes, p))]
        local = basis.mapping.invF(p[:, :, None], tind=element)
        F = np.zeros((p.shape[1], 3, 3)) + np.eye(3)
        for k in range(basis.Nbfun):
            gradient = basis.elem.gbasis(basis.mapping, local, k, tind=element)[0].grad[:, :, 0]
            F += np.einsum('pi,Jp->piJ', u.reshape(-1, 3)[basis.element_dofs[k, element]], gradient)
        P = solid.stress(F[:, None], None)[0][:, 0]
        s = P @ np.swapaxes(F, 1, 2) / np.linalg.det(F)[:, None, None]
        for row, (i, j) in zip(total, PAIRS):
            row += np.bincount(flat[part], s[:, i, j], len(row))
    return (total / count / (YOUNG * STRAIN)).reshape(6, *shape)


def run(law, elem, n, levels=0):
    start = time.time()
    solid, u, reaction, axes = solve(law, elem, n, levels)
    data = {'reaction': reaction, 'mean10': volume_average(solid, u, H)}
    if n % 2 == 0:
        data['mean05'] = volume_average(solid, u, H / 2)
    if elem == 'hex2' and n % 2 == 0:
        data['points10'], data['points05'] = point_average(solid, u, axes, H), point_average(solid, u, axes, H / 2)
    os.makedirs('results', exist_ok=True)
    np.savez_compressed(f'results/block_1pct_{law}_{elem}_n{n}_g{levels}.npz', **data)
    row = dict(law=law, elem=elem, n_per_cell=n, graded=levels, dofs=solid.size, reaction='%.7f' % reaction, seconds='%.0f' % (time.time() - start))
    path = 'results/block_1pct_summary.csv'
    new = not os.path.exists(path)
    with open(path, 'a', newline='') as file:
        writer = csv.DictWriter(file, row.keys())
        if new:
            writer.writeheader()
        writer.writerow(row)
    print(row, flush=True)


def relative_l2(a, b, k=2, mask=np.s_[:]):
    return np.sqrt(((a[k] - b[k])[mask] ** 2).sum() / (b[k][mask] ** 2).sum())


def export():
    import glob
    rows = []
    for law in LAWS:
        load = lambda elem, n, levels: np.load(f'results/block_1pct_{law}_{elem}_n{n}_g{levels}.npz')
        best = load(*REFERENCE)
        note = (f'tools/fem/block_finite_strain.py {law} {" ".join(map(str, REFERENCE))}; Cauchy stress / (E eps0), eps0 = 0.01, compression negative; '
                f'x, y, z (m) are cell centres of the undeformed 1 x 1 x 2 m block; R/(E A eps0) = {float(best["reaction"]):.6f}; %s')
        head = ['i', 'j', 'k', 'x', 'y', 'z', *STRESSES]
        for key, size, name, what in (('mean10', H, 'cell_average_full', 'mean over the cell volume'), ('points10', H, 'cell_points_full', 'mean of the 8 points at +-h/4'),
                                      ('mean05', H / 2, 'cell_average_full_h05', 'mean over the cell volume'), ('points05', H / 2, 'cell_points_full_h05', 'mean of the 8 points at +-h/4')):
            write_csv('block_1pct', f'{name}_{law}.csv', note % f'{what}, cells of {size} m, hex27, 2 elements per 0.1 m, graded 6 times', head, cell_rows(full_block(best[key]), size))
        for n, key, name in ((1, 'mean10', 'cell_average_full_gimpm_limit'), (2, 'mean05', 'cell_average_full_gimpm_limit_h05')):
            limit = load('hex1mid', n, 0)
            text = (f'tools/fem/block_finite_strain.py {law} hex1mid {n}; Cauchy stress / (E eps0), static limit of total-Lagrangian uGIMP on a grid of {H / n} m '
                    f'(hex8, 2x2x2 mid-point rule), mean of the 8 points; R/(E A eps0) = {float(limit["reaction"]):.6f}')
            write_csv('block_1pct', f'{name}_{law}.csv', text, head, cell_rows(full_block(limit[key]), H / n))
        for path in sorted(glob.glob(f'results/block_1pct_{law}_*.npz')):
            d, inner = np.load(path), np.s_[:, :, :-1]
            edge = np.ones(best['mean10'].shape[1:], bool)
            edge[-1, :, -1] = edge[:, -1, -1] = False
            row = [os.path.basename(path)[11:-4], float(d['reaction']), float(d['reaction'] / best['reaction'] - 1), relative_l2(d['mean10'], best['mean10']),
                   relative_l2(d['mean10'], best['mean10'], mask=edge), relative_l2(d['mean10'], best['mean10'], mask=inner)]
            row += [relative_l2(d[key], best[key]) if key in d else float('nan') for key in ('points10', 'mean05', 'points05')]
            row.append(float(np.abs(d['mean10'][2] - best['mean10'][2]).max()))
            rows.append(row)
            print(('%-28s' + ' %.6g' * 9) % tuple(row))
    write_csv('block_1pct', 'convergence.csv', f'tools/fem/block_finite_strain.py export; relative L2 distance of sigma_zz from {" ".join(map(str, REFERENCE))}',
              ['run', 'reaction', 'reaction_error', 'L2_cells', 'L2_without_end_edge_cells', 'L2_without_end_layers', 'L2_points_h10', 'L2_cells_h05', 'L2_points_h05', 'max_cells'], rows)


if __name__ == '__main__':
    if sys.argv[1] == 'export':
        export()
    else:
        run(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]) if len(sys.argv) > 4 else 0)
