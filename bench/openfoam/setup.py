"""The case that Livebed and OpenFOAM are compared on, written for either.

Flow past a pipe over a flat bed after Oner et al. (2008): Re_D 9500, e/D 0.3, box of 30 D x 3.5 D, the pipe 10 D from
the inlet.  Inlet: smooth log law with the depth mean U0 and the k, epsilon of an open channel in equilibrium; smooth
wall functions on bed and pipe, symmetry lid, standard k-epsilon.  SI units; x = 0 under the pipe's centre.
"""
import math
import os

D, U0, GAP = 0.05, 0.197, 0.3
R, YC = 0.5 * D, (GAP + 0.5) * D
X_IN, X_OUT, H = -10 * D, 20 * D, 3.5 * D
KAPPA, E, C_MU = 0.41, 9.0, 0.09
SLAB = 0.1 * D  # thickness of OpenFOAM's single layer of cells
ROWS = 94  # of Livebed's uniform 540 x 94 grid: its row height is the first cell at bed and pipe on all grids
FIRST = H / ROWS
STATIONS = (-2, 0, 1, 2, 4, 8)  # x/D of the velocity profiles


def use_reynolds(number):
    """Sets the viscosity NU = U0 D / number and the inlet's U_STAR, Z0: u* of the smooth log law with depth mean U0,
    U0 = u*/kappa (ln(H/z0) - 1 + z0/H), z0 = nu/(E u*)."""
    global NU, U_STAR, Z0
    NU = U0 * D / number
    U_STAR = 0.05 * U0
    for _ in range(60):
        Z0 = NU / (E * U_STAR)
        U_STAR = U0 * KAPPA / (math.log(H / Z0) - 1 + Z0 / H)


use_reynolds(9500.0)


def inlet_u(y):
    return U_STAR / KAPPA * math.log(y / Z0) if y > Z0 else 0.0


def inlet_k(y):
    return max(1e-10, U_STAR**2 / math.sqrt(C_MU) * (1 - y / H))


def inlet_epsilon(y):
    return max(1e-12, U_STAR**3 / (KAPPA * max(y, Z0)) * (1 - y / H))


# ------------------------------------------------------------------------------------------------------- Livebed


def write_livebed(path, mesh, end, closure="k_epsilon", convection="bounded", courant=0.85, tolerance=1e-4,
                  damping=True):
    """A case file without grains; mesh is a dictionary of the keys of [mesh] beside length and height; damping: whether
    epsilon at walls has the paper's Van Driest factor, which OpenFOAM's has not."""
    keys = "\n".join(f"{k} = {v!r}" for k, v in mesh.items())
    with open(path, "w") as f:
        f.write(f"""[mesh]
length = {X_OUT - X_IN}
height = {H}
{keys}
[pipe]
diameter = {D}
x = {-X_IN}
gap_ratio = {GAP}
[flow]
viscosity = {NU!r}
closure = "{closure}"
convection = "{convection}"
floor = "smooth"
wall_damping = {str(damping).lower()}
courant = {courant}
max_step = 0.1
pressure_tolerance = {tolerance}
[current]
profile = "smooth"
mean_speed = {U0}
[bed]
count = 0
floor = "plane"
[time]
end = {end}
""")


# ------------------------------------------------------------------------------------------------------ OpenFOAM

# Body-fitted grids.  Cells: around (along each side of the square round the pipe), above (rows between square and lid),
# before and behind it; rest of the two first-cell heights over the bed, rest of the ring of three round the pipe, from
# there to the square.
FITTED = {
    "coarse": dict(around=28, above=18, before=58, behind=110, strip=1, ring=2, outer=4),
    "medium": dict(around=40, above=27, before=84, behind=160, strip=2, ring=3, outer=6),
    "fine": dict(around=68, above=40, before=132, behind=256, strip=4, ring=6, outer=10),
}


def expansion(length, cells, first):
    """Last over first cell of a geometric row of cells that fills the length."""
    low, high = 0.2, 5.0
    for _ in range(200):
        ratio = math.sqrt(low * high)
        total = first * (cells if abs(ratio - 1) < 1e-12 else (ratio**cells - 1) / (ratio - 1))
        low, high = (ratio, high) if total < length else (low, ratio)
    return ratio ** (cells - 1)


def dictionary(case, path, body, of="dictionary"):
    full = os.path.join(case, path)
    os.makedirs(os.path.dirname(full), exist_ok=True)
    with open(full, "w") as f:
        name = os.path.basename(path)
        f.write(f"FoamFile {{ version 2.0; format ascii; class {of}; object {name}; }}\n{body}")


def block_mesh(case, points, blocks, edges, sides, empties):
    """blockMeshDict from points in the plane: blocks (four corners counter-clockwise, cells, gradings), arcs (two
    points, a point between), sides {patch: (type, [(point, point)])}, the quadrilaterals that front and back consist
    of."""
    n = len(points)
    vertices = "\n".join(f"({x:.12g} {y:.12g} {z:.12g})" for z in (0, SLAB) for x, y in points)
    hexes = "\n".join(
        f"hex ({' '.join(str(p) for p in q)} {' '.join(str(p + n) for p in q)}) ({nx} {ny} 1) "
        f"simpleGrading ({gx} {gy} 1)"
        for q, (nx, ny), (gx, gy) in blocks)
    arcs = "\n".join(f"arc {a + k} {b + k} ({x:.12g} {y:.12g} {z:.12g})"
                     for a, b, x, y in edges for k, z in ((0, 0), (n, SLAB)))
    patches = "\n".join(
        f"{name} {{ type {kind}; faces ({' '.join(f'({a} {b} {b + n} {a + n})' for a, b in faces)}); }}"
        for name, (kind, faces) in sides.items())

    def quadrilaterals(k):
        return " ".join(f"({' '.join(str(p + k) for p in q)})" for q in empties)

    flat = [f"{name} {{ type empty; faces ({quadrilaterals(k)}); }}" for name, k in (("back", 0), ("front", n))]
    dictionary(case, "system/blockMeshDict",
               f"scale 1;\nvertices\n(\n{vertices}\n);\nblocks\n(\n{hexes}\n);\nedges\n(\n{arcs}\n);\n"
               f"boundary\n(\n{patches}\n" + "\n".join(flat) + "\n);\n")


def fitted_mesh(case, level, at_pipe=FIRST):
    """O-grid round the pipe inside a square, Cartesian blocks around; at_pipe: height of the cells on the pipe, when
    lower than FIRST the ring's cells grow away from it.  Returns the number of cells."""
    c = FITTED[level]
    strip, ring = 2 * FIRST, R + 3 * FIRST
    half = YC - strip
    rows = (0.0, strip, YC + half, H)
    columns = (X_IN, -half, half, X_OUT)
    points = [(x, y) for y in rows for x in columns]  # 4 row + column
    corner = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    for radius in (ring, R):  # 16..19, 20..23
        points += [(a * radius / math.sqrt(2), YC + b * radius / math.sqrt(2)) for a, b in corner]
    side = 2 * half / c["around"]
    before = 1 / expansion(-X_IN - half, c["before"], side)
    behind = expansion(X_OUT - half, c["behind"], side)
    above = expansion(H - rows[2], c["above"], side)

    def wall_rows(height, rest):
        """One cell of the height FIRST, the rest equal."""
        share = FIRST / height
        return f"(({share:.12g} {1 / (1 + rest):.12g} 1) ({1 - share:.12g} {rest / (1 + rest):.12g} 1))"

    bed, pipe, in_ring = wall_rows(strip, c["strip"]), wall_rows(ring - R, c["ring"]), 1 + c["ring"]
    if at_pipe < FIRST:
        while expansion(ring - R, in_ring, at_pipe) ** (1 / (in_ring - 1)) > 1.2:
            in_ring += 1
        pipe = expansion(ring - R, in_ring, at_pipe)
    wide = ((0, c["before"], before), (1, c["around"], 1), (2, c["behind"], behind))
    high = ((0, 1 + c["strip"], bed), (1, c["around"], 1), (2, c["above"], above))
    blocks, empties = [], []
    for j, ny, gy in high:
        for i, nx, gx in wide:
            if (i, j) == (1, 1):
                continue
            q = (4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4)
            blocks.append((q, (nx, ny), (gx, gy)))
            empties.append(q)
    square = (5, 6, 10, 9)
    for s in range(4):
        t = (s + 1) % 4
        # From outside in, so that the corners run counter-clockwise; the ring's first cell on the pipe comes last.
        q = (square[s], square[t], 16 + t, 16 + s)
        blocks.append((q, (c["around"], c["outer"]), (1, 1)))
        empties.append(q)
        q = (20 + t, 20 + s, 16 + s, 16 + t)
        blocks.append((q, (c["around"], in_ring), (1, pipe)))
        empties.append(q)
    edges = []
    for s in range(4):
        angle = math.radians(-90 + 90 * s)
        for start, radius in ((16, ring), (20, R)):
            edges.append((start + s, start + (s + 1) % 4, radius * math.cos(angle), YC + radius * math.sin(angle)))
    block_mesh(case, points, blocks, edges, {
        "inlet": ("patch", [(4 * j, 4 * j + 4) for j in range(3)]),
        "outlet": ("patch", [(4 * j + 3, 4 * j + 7) for j in range(3)]),
        "bed": ("wall", [(i, i + 1) for i in range(3)]),
        "top": ("symmetryPlane", [(12 + i, 13 + i) for i in range(3)]),
        "pipe": ("wall", [(20 + s, 20 + (s + 1) % 4) for s in range(4)]),
    }, empties)
    return sum(nx * ny for _, (nx, ny), _ in blocks)


def cartesian_mesh(case, nx, ny):
    """Equal cells, those whose centre lies in the pipe taken out (topoSet, subsetMesh): a staircase."""
    points = [(X_IN, 0), (X_OUT, 0), (X_OUT, H), (X_IN, H)]
    block_mesh(case, points, [((0, 1, 2, 3), (nx, ny), (1, 1))], [], {
        "inlet": ("patch", [(0, 3)]), "outlet": ("patch", [(1, 2)]), "bed": ("wall", [(0, 1)]),
        "top": ("symmetryPlane", [(2, 3)]), "pipe": ("wall", []),
    }, [(0, 1, 2, 3)])
    dictionary(case, "system/topoSetDict", f"""actions
(
{{ name fluid; type cellSet; action new; source cylinderToCell; p1 (0 {YC} -1); p2 (0 {YC} 1); radius {R}; }}
{{ name fluid; type cellSet; action invert; }}
);
""")
    return nx * ny


def write_openfoam(case, *, correctors, non_orthogonal, end, wall="nutk", scheme="linearUpwind",
                   scalars="limitedLinear 1", time="backward", courant=0.85, step=1e-3, fixed_step=False,
                   average_from=None, processes=1):
    """Fields, physics, schemes and control of a case whose mesh is there.  wall: nutk or nutU, the velocity scale of
    the smooth law.  average_from: time from which means are taken and forces written; None: no functions."""
    ys = [0.0] + [H * 1e-4 ** (1 - i / 400) for i in range(401)]

    def profile(f, vector=False):
        rows = " ".join(f"({y:.9g} ({f(y):.9g} 0 0))" if vector else f"({y:.9g} {f(y):.9g})" for y in ys)
        return f"type fixedProfile; direction (0 1 0); origin 0; profile table ( {rows} );"

    k0, e0 = inlet_k(0.5 * H), inlet_epsilon(0.5 * H)
    law = f"kappa {KAPPA}; E {E}; Cmu {C_MU};"

    def field(name, kind, dimensions, inside, inlet, walls, outlet):
        dictionary(case, f"0.orig/{name}", f"""dimensions {dimensions};
internalField uniform {inside};
boundaryField
{{
    inlet {{ {inlet} value uniform {inside}; }}
    outlet {{ {outlet} value uniform {inside}; }}
    "(bed|pipe)" {{ {walls} value uniform {inside}; }}
    top {{ type symmetryPlane; }}
    "(front|back)" {{ type empty; }}
}}
""", kind)

    def out(value):
        return f"type inletOutlet; inletValue uniform {value};"

    field("U", "volVectorField", "[0 1 -1 0 0 0 0]", f"({U0} 0 0)", profile(inlet_u, True), "type noSlip;",
          out("(0 0 0)"))
    flat = "type zeroGradient;"
    field("p", "volScalarField", "[0 2 -2 0 0 0 0]", "0", flat, flat, "type fixedValue;")
    field("k", "volScalarField", "[0 2 -2 0 0 0 0]", k0, profile(inlet_k), "type kqRWallFunction;", out(k0))
    field("epsilon", "volScalarField", "[0 2 -3 0 0 0 0]", e0, profile(inlet_epsilon),
          f"type epsilonWallFunction; {law}", out(e0))
    field("nut", "volScalarField", "[0 2 -1 0 0 0 0]", "0", "type calculated;", f"type {wall}WallFunction; {law}",
          "type calculated;")
    dictionary(case, "constant/transportProperties", f"transportModel Newtonian;\nnu {NU!r};\n")
    dictionary(case, "constant/turbulenceProperties",
               "simulationType RAS;\nRAS { RASModel kEpsilon; turbulence on; printCoeffs off; }\n")
    convection = f"Gauss {scheme}" + (" grad(U)" if scheme == "linearUpwind" else "")
    dictionary(case, "system/fvSchemes", f"""ddtSchemes {{ default {time}; }}
gradSchemes {{ default Gauss linear; }}
divSchemes
{{
    default none;
    div(phi,U) {convection};
    div(phi,k) Gauss {scalars};
    div(phi,epsilon) Gauss {scalars};
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}}
laplacianSchemes {{ default Gauss linear corrected; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default corrected; }}
wallDist {{ method meshWave; }}
""")
    dictionary(case, "system/fvSolution", f"""solvers
{{
    p {{ solver GAMG; smoother GaussSeidel; tolerance 1e-6; relTol 0.01; }}
    pFinal {{ $p; relTol 0; }}
    "(U|k|epsilon)" {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0.01; }}
    "(U|k|epsilon)Final" {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0; }}
}}
PIMPLE {{ nOuterCorrectors 1; nCorrectors {correctors}; nNonOrthogonalCorrectors {non_orthogonal}; }}
""")
    functions = "" if average_from is None else f"""functions
{{
    forces
    {{
        type forceCoeffs; libs ("libforces.so"); patches (pipe); rho rhoInf; rhoInf 1; CofR (0 {YC} 0);
        liftDir (0 1 0); dragDir (1 0 0); pitchAxis (0 0 1); magUInf {U0}; lRef {D}; Aref {D * SLAB};
        writeControl timeStep; writeInterval 1;
    }}
    wallShear
    {{
        type wallShearStress; libs ("libfieldFunctionObjects.so"); patches (bed pipe); writeControl writeTime;
    }}
    yPlus {{ type yPlus; libs ("libfieldFunctionObjects.so"); writeControl writeTime; }}
    means
    {{
        type fieldAverage; libs ("libfieldFunctionObjects.so"); writeControl writeTime; timeStart {average_from};
        fields
        (
            U {{ mean on; prime2Mean off; base time; }}
            k {{ mean on; prime2Mean off; base time; }}
            wallShearStress {{ mean on; prime2Mean off; base time; }}
        );
    }}
}}
"""
    # For `postProcess -func profiles`: value, centre and gradient of the cell at each height.  Interpolating sets would
    # mix the wall's zero into the first cell, and a line of samples would end at the pipe.
    heights = [H * (i + 0.5) / 700 for i in range(700)]
    sets = "\n".join(f"at{x} {{ type cloud; axis y; points ("
                     + " ".join(f"({x * D} {y:.7g} {SLAB / 2})" for y in heights) + "); }" for x in STATIONS)
    dictionary(case, "system/profiles", "type sets; libs (sampling); interpolationScheme cell; setFormat raw;\n"
               f"fields (UMean kMean C grad(UMean));\nsets\n(\n{sets}\n);\n")
    dictionary(case, "system/controlDict", f"""application pimpleFoam;
startFrom startTime;
startTime 0;
stopAt endTime;
endTime {end};
deltaT {step};
writeControl {"timeStep" if fixed_step else "adjustableRunTime"};
writeInterval {1000000 if fixed_step else end};
purgeWrite 0;
writeFormat ascii; writePrecision 8; writeCompression off; timeFormat general; timePrecision 8;
runTimeModifiable no;
adjustTimeStep {"no" if fixed_step else "yes"}; maxCo {courant}; maxDeltaT 0.01;
{functions}""")
    dictionary(case, "system/decomposeParDict",
               f"numberOfSubdomains {processes};\nmethod simple;\n"
               f"simpleCoeffs {{ n ({processes} 1 1); delta 0.001; }}\n")
