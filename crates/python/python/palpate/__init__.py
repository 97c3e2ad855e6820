"""Soft-tissue touch: measure it, fit it, simulate it.

Lengths are in metres, forces in newtons, times in seconds. What cannot be done raises `InputError`, which says what to
remedy, or another `PalpateError`.
"""

from palpate._palpate import (
    Camera,
    Mesh,
    Motion,
    OnlineEstimate,
    Recording,
    Renderer,
    Scene,
    Session,
    Simulation,
    SimulationBatch,
    Snapshot,
    State,
    Teleoperation,
    Tissue,
    __version__,
    isosurface,
)
from palpate.errors import InputError, PalpateError
from palpate.fits import Characterization, Specimen
from palpate.jobs import (
    Analysis,
    Design,
    Measurement,
    Solution,
    analyze,
    characterize,
    default_protocol,
    design,
    measure,
    precompute,
    solve,
)
from palpate.laws import FittedRecording, Law, Parameter, Relaxation

__all__ = [
    "Analysis",
    "Camera",
    "Characterization",
    "Design",
    "FittedRecording",
    "InputError",
    "Law",
    "Measurement",
    "Mesh",
    "Motion",
    "OnlineEstimate",
    "PalpateError",
    "Parameter",
    "Recording",
    "Relaxation",
    "Renderer",
    "Scene",
    "Session",
    "Simulation",
    "SimulationBatch",
    "Snapshot",
    "Solution",
    "Specimen",
    "State",
    "Teleoperation",
    "Tissue",
    "__version__",
    "analyze",
    "characterize",
    "default_protocol",
    "design",
    "isosurface",
    "measure",
    "precompute",
    "solve",
]
