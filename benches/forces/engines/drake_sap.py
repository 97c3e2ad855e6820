"""Drake's deformable body with the SAP contact solver; the force is `DeformableContactInfo.F_Ac_W`."""

import importlib.metadata
import pathlib
import tempfile
import time

import numpy as np
from pydrake.geometry import (
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Cylinder,
    GeometryInstance,
    Mesh,
    ProximityProperties,
    Sphere,
)
from pydrake.math import RigidTransform
from pydrake.multibody.fem import DeformableBodyConfig, MaterialModel
from pydrake.multibody.plant import AddMultibodyPlant, CoulombFriction, MultibodyPlantConfig
from pydrake.multibody.tree import PdControllerGains, PrismaticJoint, SpatialInertia
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.analysis import Simulator

from meshes import legacy_vtk

LAW = "corotated"
MESHES = ["coarse", "fine"]
SETTINGS = """SAP, steps of 10 ms; `kLinearCorotated`, which it recommends (its frame is that of the last step); density
1000 kg/m3, no gravity, stiffness damping 0.02 s; resolution hint of the tool 2 mm; no friction; the tool is on a
prismatic joint with gains of 1e6 N/m and 1e3 N s/m. Tuned: damping and hint, by the sphere on the cube."""
STEP = 0.01  # [s]


def version():
    return importlib.metadata.version("drake")


def unfit(scene):
    return "a body has one material" if scene.second else scene.not_a_press()


def run(scene, mesh):
    began = time.perf_counter()
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(
        MultibodyPlantConfig(time_step=STEP, discrete_contact_approximation="sap"), builder
    )
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    smooth = CoulombFriction(0.0, 0.0)

    config = DeformableBodyConfig()
    config.set_youngs_modulus(scene.tissue["youngs_modulus_pa"])
    config.set_poissons_ratio(scene.tissue["poissons_ratio"])
    config.set_mass_density(1000.0)
    config.set_stiffness_damping_coefficient(0.02)
    config.set_material_model(MaterialModel.kLinearCorotated)
    properties = ProximityProperties()
    AddContactMaterial(friction=smooth, properties=properties)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "body.vtk"
        path.write_text(legacy_vtk(mesh.nodes, mesh.elements))
        instance = GeometryInstance(RigidTransform(), Mesh(str(path)), "body")
        instance.set_proximity_properties(properties)
        deformables = plant.mutable_deformable_model()
        body = deformables.RegisterDeformableBody(instance, config, 1.0)
    for point, normal in scene.planes:
        deformables.SetWallBoundaryCondition(body, point, normal)

    ball = scene.tool["shape"] == "sphere"
    above = scene.radius if ball else 0.5 * scene.radius
    tool = plant.AddRigidBody("tool", SpatialInertia.SolidSphereWithMass(1.0, scene.radius))
    properties = ProximityProperties()
    AddContactMaterial(friction=smooth, properties=properties)
    # The tool needs a surface of its own to meet a deformable body.
    AddRigidHydroelasticProperties(0.002, properties)
    shape = Sphere(scene.radius) if ball else Cylinder(scene.radius, scene.radius)
    plant.RegisterCollisionGeometry(tool, RigidTransform(), shape, "tool", properties)
    joint = plant.AddJoint(PrismaticJoint("lift", plant.world_frame(), tool.body_frame(), [0, 0, 1]))
    actuator = plant.AddJointActuator("lift", joint)
    actuator.set_controller_gains(PdControllerGains(p=1e6, d=1e3))
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    joint.set_translation(context, above)
    wanted = plant.get_desired_state_input_port(tool.model_instance())
    wanted.FixValue(context, [above, 0.0])
    simulator.Initialize()

    times = scene.times(STEP)
    forces, settled, durations, first = [], [], [], None
    for now in times:
        wanted.FixValue(context, [above - scene.depth(now), -scene.speed(now, STEP)])
        before = time.perf_counter()
        simulator.AdvanceTo(now)
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        results = plant.get_contact_results_output_port().Eval(context)
        found = [results.deformable_contact_info(i).F_Ac_W() for i in range(results.num_deformable_contacts())]
        forces.append(abs(sum(force.translational()[2] for force in found)))
        settled.append(mesh.settling(deformables.GetPositions(context, body).T))
    return {"time": times, "force": np.array(forces), "settled": np.array(settled), "steps_s": durations, "first_s": first}
