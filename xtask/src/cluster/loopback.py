"""A server of HyperQueue, or one worker of it, as a process of its own: the package has both, but a worker of a server in the same process alone.

    loopback.py server DIRECTORY DIRECTORY
    loopback.py worker DIRECTORY SERVER
"""

import sys
from pathlib import Path

from hyperqueue import LocalCluster
from hyperqueue.cluster import WorkerConfig

CURRENT = "hq-current"

role, directory, server = sys.argv[1], *(Path(path).resolve() for path in sys.argv[2:])
cluster = LocalCluster(server_dir=str(directory))
if role == "worker":
    # the worker finds its server by this link
    link = directory / CURRENT
    link.unlink()
    link.symlink_to((server / CURRENT).resolve())
    cluster.start_worker(WorkerConfig(cores=1))
print("ready", flush=True)
sys.stdin.read()
