"""FElupe: axisymmetric quadratic elements; other bodies are those of `felupe_solid`. A reference code; `answers.py` uses
it with every engine's law."""

import importlib.metadata
import time

import felupe
import numpy as np

from engines import felupe_solid
from laws import LAWS, PLANE, Material
from scene import lame

LAW = "neo_hookean"
MESHES = [None]
SETTINGS = """Nine-noded quadrilaterals, 0.05 radii long under the tool; a box is a cylinder whose top has the same
area. Sphere: `ContactRigidCylinder` on `FieldAxisymmetric`, 20 times the mean stiffness of its nodes. Flat punch:
prescribed nodes. Bodies that are not axisymmetric: tetrahedra of ten nodes by gmsh; sphere: augmented Lagrangian at seven
points of each triangle under it, penalty of 100 moduli a radius, augmented once; grip: prescribed nodes."""
EDGE = 0.05  # [radii]
INCREMENT = 0.025  # of depth [radii]


def version():
    return importlib.metadata.version("felupe")


def unfit(scene):
    return "no relaxation in this adapter" if scene.prony else None


def graded(edge, even, length, growth):
    """Places from 0 to length: intervals of `edge` up to `even`, then longer and longer."""
    places, step = [0.0], edge
    while places[-1] < length - 0.5 * step:
        places.append(places[-1] + step)
        step = step if places[-1] < even else min(step * growth, 0.1 * length)
    return np.array(places) * (length / places[-1])


def parameters(scene, edge):
    """Places of the columns, across, and of the rows, down; angles across on a hemisphere."""
    radius, growth = scene.radius, 1 + 3 * edge
    first = edge * radius
    if scene.tool["shape"] == "flat":
        # Stress is infinite at the punch's edge.
        first, growth = 0.25 * first, 1 + 4 * edge
        inner = radius - graded(first, 0.0, radius, growth)[::-1]
        outer = radius + graded(first, 0.0, width(scene) - radius, growth)
        return np.concatenate([inner, outer[1:]]), graded(first, 0.0, scene.height, growth)
    even = 1.2 * radius
    deep = scene.inclusion["depth_m"] + scene.inclusion["radius_m"] if scene.inclusion else 0.6 * radius
    if scene.layer:
        # Elements end at the face between the layers.
        thickness = scene.layer["thickness_m"]
        upper = np.linspace(0.0, thickness, round(thickness / first) + 1)
        below = graded(first, max(deep - thickness, 0.0), scene.height - thickness, growth)
        down = np.concatenate([upper, thickness + below[1:]])
    else:
        down = graded(first, deep, scene.height, growth)
    if scene.body["shape"] == "hemisphere":
        return graded(first / scene.height, even / scene.height, np.pi / 2, growth), down
    return graded(first, even, width(scene), growth), down


def width(scene):
    return scene.body["side_m"] / np.sqrt(np.pi)


def mesh_of(scene, edge):
    """A mesh in axial (top at 0, upwards) and radial coordinates, the middle of the tool as its last point."""
    across, down = parameters(scene, edge)
    grid = felupe.Rectangle(n=(len(down), len(across)))
    i, j = [np.rint(grid.points[:, k] * (len(axis) - 1)).astype(int) for k, axis in enumerate([down, across])]
    grid.points[:] = np.column_stack([down[i], across[j]])
    mesh = grid.add_midpoints_edges(cell_type="quad8").add_midpoints_faces(cell_type="quad9")
    depth, place = mesh.points.T.copy()
    if scene.body["shape"] == "hemisphere":
        distance = scene.height - depth
        mesh.points[:] = np.column_stack([distance * np.cos(place) - scene.height, distance * np.sin(place)])
    else:
        mesh.points[:] = np.column_stack([-depth, place])
    # Downwards was the first coordinate: elements are turned.
    mesh.cells[:] = mesh.cells[:, [0, 3, 2, 1, 7, 6, 5, 4, 8]]
    top = np.flatnonzero(depth < 1e-12)
    top = top[np.argsort(mesh.points[top, 1])]
    mesh.add_points([scene.radius, 0.0])
    mesh.points_without_cells = mesh.points_without_cells[mesh.points_without_cells != mesh.npoints - 1]
    return mesh, top


def material(scene, law, region):
    mu, lam = scene.lame
    if scene.second:
        points = np.einsum("caI,aqc->Iqc", region.mesh.points[region.mesh.cells], region.h + np.zeros((1, 1, len(region.mesh.cells))))
        inside = scene.in_second(points[1], points[0])
        stiff = lame(scene.second["youngs_modulus_pa"], scene.tissue["poissons_ratio"])
        mu, lam = [np.where(inside, hard, soft) for hard, soft in zip(stiff, (mu, lam))]
    return Material(LAWS[law], mu, lam, PLANE)


def pressed(scene, law, edge, depths):
    """Force [N] and settlement of the probe [m] at each of rising depths [m]; NaN from where it is not solved."""
    mesh, top = mesh_of(scene, edge)
    region = felupe.RegionBiQuadraticQuad(mesh)
    field = felupe.FieldContainer([felupe.FieldAxisymmetric(region, dim=2)])
    solid = felupe.SolidBody(umat=material(scene, law, region), field=field)
    items = [solid]
    place = mesh.points[:, 0]
    base = place < -scene.height * (1 - 1e-9)
    axis = (np.abs(mesh.points[:, 1]) < 1e-12) & ~base
    middle = np.arange(mesh.npoints) == mesh.npoints - 1
    boundaries = {
        "base": felupe.Boundary(field[0], mask=base),
        "axis": felupe.Boundary(field[0], mask=axis & ~middle, skip=(1, 0)),
        "aside": felupe.Boundary(field[0], mask=middle, skip=(1, 0)),
    }
    if scene.tool["shape"] == "flat":
        face = np.zeros(mesh.npoints, dtype=bool)
        face[top[mesh.points[top, 1] <= scene.radius * (1 + 1e-9)]] = True
        boundaries["move"] = felupe.Boundary(field[0], mask=face | middle, skip=(0, 1))
    else:
        boundaries["move"] = felupe.Boundary(field[0], mask=middle, skip=(0, 1))
        reach = top[mesh.points[top, 1] < 1.6 * scene.radius]
        items.append(felupe.ContactRigidCylinder(
            field=field, points=reach, centerpoint=-1, radius=scene.radius, multiplier=20.0, items=[solid]
        ))
    forces, settled = [], []
    try:
        step = felupe.Step(items=items, boundaries=boundaries, ramp={boundaries["move"]: -np.asarray(depths)})
        for _ in step.generate(x0=field, verbose=0, tol=1e-6, maxiter=40):
            inner = solid.results.force.toarray().reshape(-1, 2)
            forces.append(float(inner[base, 0].sum()))
            moved = field[0].values
            probed = np.interp(scene.probe, mesh.points[top, 1], moved[top, 0])
            settled.append(float(-probed))
    except Exception as error:  # The code raises several types; each says that it found no equilibrium.
        print(f"{scene.name}, {law}: {error}")
    missing = [np.nan] * (len(depths) - len(forces))
    return np.array(forces + missing), np.array(settled + missing), mesh.npoints


def run(scene, _mesh):
    began = time.perf_counter()
    depths = np.linspace(0, scene.path.max(), round(scene.path.max() / (INCREMENT * scene.radius)) + 1)[1:]
    if scene.axisymmetric:
        force, settled, nodes = pressed(scene, LAW, EDGE, depths)
    else:
        # The coarser of the meshes whose difference is the answers' error.
        force, settled, nodes = felupe_solid.pressed(scene, LAW, felupe_solid.MESHES[scene.name][0], depths)
    seconds = time.perf_counter() - began
    times = scene.times(0.005)
    at = scene.depth(times)
    return {
        "time": times,
        "force": np.interp(at, [0, *depths], [0, *force]),
        "settled": np.interp(at, [0, *depths], [0, *settled]),
        "steps_s": [seconds / len(depths)] * len(depths),
        "first_s": seconds,
        "nodes": nodes,
    }
