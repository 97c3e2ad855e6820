"""A hand demonstrates palpation through a haptic device, feels the tissue, and leaves a session.

python examples/python/teleoperate.py --device haply
python examples/python/teleoperate.py --device virtual     # a scripted hand, without a device
python examples/python/teleoperate.py --device mouse       # this program moves the tool
"""

import argparse
import time

import numpy as np
import palpate


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    devices = ["haply", "openhaptics", "force_dimension", "virtual", "mouse"]
    parser.add_argument("--device", choices=devices, default="virtual")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0, help="where the lump lies")
    parser.add_argument("--folder", default="demonstration")
    chosen = parser.parse_args()

    scene = palpate.Scene.builtin("palpation", seed=chosen.seed)
    simulation = palpate.Simulation(scene)
    surface = simulation.surface
    front = int(surface.vertices[:, 1].argmin())

    largest = 0.0
    with palpate.Teleoperation(simulation, chosen.folder, devices={"right": chosen.device}, overwrite=True) as touch:
        while touch.is_running and touch.time < chosen.seconds:
            if chosen.device == "mouse":
                depth = 0.003 * np.sin(2 * np.pi * 0.5 * touch.time)
                touch.move("right", surface.vertices[front] - depth * surface.normals[front])
            largest = max(largest, float(np.linalg.norm(touch.forces[0])))
            time.sleep(0.01)
        faults = [fault for fault in touch.faults if fault]
    for fault in faults:
        print(fault)

    session = palpate.Session.read(chosen.folder)
    print(f"{len(session)} rows in {chosen.folder}, the largest force {1e3 * largest:.0f} mN")
    assert largest > 0.0, "the hand touched nothing"


if __name__ == "__main__":
    main()
