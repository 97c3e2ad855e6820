"""Studies: many jobs at once, on one machine or many, kept as they finish.

A study is a list of tasks. A task is one job with everything that it is given, so that it can be done anywhere and
gives the same answer to the last bit; its key is the digest of what it is given. `run` does what is not yet kept in
the folder of the study, here or on the workers of a Dask client.

>>> tasks = characterizations("recordings/", laws=("neo_hookean", "mooney_rivlin"))
>>> study = run(tasks, "livers")
>>> study.to_frame()
"""

from palpate.study.plan import characterizations, precomputations, solves
from palpate.study.run import Study, run
from palpate.study.task import Task

__all__ = ["Study", "Task", "characterizations", "precomputations", "run", "solves"]
