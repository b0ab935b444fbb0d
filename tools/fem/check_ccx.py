"""The finite-strain references again with CalculiX 2.20 (another code, other elements).  usage: check_ccx.py [csm1|cook|block ...]
csm1   St Venant-Kirchhoff (CalculiX's *ELASTIC with NLGEOM), CPE8, body force   -> tip displacement
cook   W = mu/2 (I1bar - 3) + K/2 (J - 1)^2 (*HYPERELASTIC, NEO HOOKE), nu 0.4, CPE8, nodal forces -> corner, middle
block  St Venant-Kirchhoff, C3D20R, 2 elements a cell                           -> reaction
Work files go to ccx_work/.
"""
import io
import os
import subprocess
import sys
import numpy as np
import block_common
import cooks_membrane
import csm1
import gen_ccx_inp
from hyperelastic import lame
from skfem import Basis, ElementQuad2


def run(name, deck):
    os.makedirs('ccx_work', exist_ok=True)
    with open(f'ccx_work/{name}.inp', 'w') as file:
        file.write(deck)
    subprocess.run(['ccx', name], cwd='ccx_work', check=True, stdout=subprocess.DEVNULL, env=dict(os.environ, OMP_NUM_THREADS='1'))
    lines = [line.split() for line in open(f'ccx_work/{name}.dat')]
    last = max(k for k, line in enumerate(lines) if 'time' in line)
    return [list(map(float, line)) for line in lines[last + 1:] if line]


def plane_deck(mesh, material, clamped, watched, load, forces=()):
    """8-node plane-strain deck; clamped, watched and forces select nodes by position."""
    basis = Basis(mesh, ElementQuad2())
    x = basis.doflocs
    conn = basis.element_dofs[:8].T                  # 4 corners, 4 edge middles (the ninth node is inside)
    a, b, c = (x[:, conn[0, k]] for k in range(3))
    if np.linalg.det(np.array([b - a, c - a])) < 0:  # CalculiX wants them anticlockwise
        conn = conn[:, [0, 3, 2, 1, 7, 6, 5, 4]]
    used = np.unique(conn)
    text = ['*NODE, NSET=ALL'] + ['%d, %.12g, %.12g, 0' % (n + 1, *x[:, n]) for n in used]
    text += ['*ELEMENT, TYPE=CPE8, ELSET=EALL'] + [', '.join(map(str, [e + 1, *(c + 1)])) for e, c in enumerate(conn)]
    node = lambda p: used[np.linalg.norm(x[:, used] - np.array(p)[:, None], axis=0).argmin()] + 1
    text += ['*NSET, NSET=CLAMP'] + ['%d,' % (n + 1) for n in used if clamped(x[:, n])]
    text += ['*NSET, NSET=WATCHED'] + ['%d,' % node(p) for p in watched]
    text += ['*MATERIAL, NAME=M', material, '*SOLID SECTION, ELSET=EALL, MATERIAL=M', '1.0', '*STEP, NLGEOM, INC=200', '*STATIC', '0.1, 1.0',
             '*BOUNDARY', 'CLAMP, 1, 2', load] + ['%d, 2, %.12g' % (node(p), f) for p, f in forces]
    text += ['*NODE PRINT, NSET=WATCHED', 'U', '*END STEP', '']
    return '\n'.join(text)


def check_csm1(thickness_elements=8, levels=4):
    material = '*ELASTIC\n%g, %g\n*DENSITY\n%g' % (csm1.YOUNG, csm1.POISSON, csm1.DENSITY)
    tip = (csm1.LEFT + csm1.LENGTH, csm1.BOTTOM + csm1.HEIGHT / 2)
    deck = plane_deck(csm1.mesh(thickness_elements, levels), material, lambda p: p[0] < csm1.LEFT + 1e-9, [tip], '*DLOAD\nEALL, GRAV, %g, 0, -1, 0' % csm1.GRAVITY)
    values = run('csm1', deck)
    print('csm1 CPE8', thickness_elements, levels, 'ux uy (mm)', [1e3 * v for v in values[-1][1:3]], flush=True)


def check_cook(n=32, levels=5, poisson=0.4):
    mu, lam = lame(cooks_membrane.YOUNG, poisson)
    mesh = cooks_membrane.membrane(n, levels)
    x = Basis(mesh, ElementQuad2()).doflocs
    edge = np.sort(x[1, x[0] > 48 - 1e-9])
    force = np.zeros(len(edge))
    for k in range(0, len(edge) - 1, 2):
        force[k:k + 3] += cooks_membrane.FORCE / 16 * (edge[k + 2] - edge[k]) * np.array([1, 4, 1]) / 6
    deck = plane_deck(mesh, '*HYPERELASTIC, NEO HOOKE\n%.12g, %.12g' % (mu / 2, 2 / (lam + 2 * mu / 3)), lambda p: p[0] < 1e-9, [(48, 60), (48, 52)], '*CLOAD',
                      [((48, y), f) for y, f in zip(edge, force)])
    print('cook CPE8', n, levels, 'nu', poisson, 'nodes, ux uy (mm)', run('cook', deck), flush=True)


def check_block(n=2, levels=0):
    block_common.E = gen_ccx_inp.E = 30e9
    gen_ccx_inp.DELTA = 0.02
    deck = io.StringIO()
    gen_ccx_inp.write('C3D20R', n, levels, False, deck)
    text = deck.getvalue().replace('*STEP\n*STATIC\n', '*STEP, NLGEOM\n*STATIC\n1.0, 1.0\n')
    head, tail = text.split('*NODE PRINT')
    force = run('block', head + '*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n*END STEP\n')
    print('block C3D20R', n, levels, 'R/(E A eps0) =', -4 * force[-1][2] / (30e9 * 0.01), flush=True)


if __name__ == '__main__':
    for name in sys.argv[1:] or ('csm1', 'cook', 'block'):
        {'csm1': check_csm1, 'cook': check_cook, 'block': check_block}[name]()
