"""A real SLURM cluster of one node on loopback, in a scratch folder, from Debian's packages.

``python tests/cluster/one_node.py COMMAND ...`` starts it, runs a command against it and takes it down again;
``--missing`` only names the packages that it lacks, and fails if there are any.
"""

from __future__ import annotations

import getpass
import os
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

PATIENCE = 30.0  # s
# What has to be installed, and the Debian package that brings it; the daemons stand outside a user's path.
PACKAGES = {"munged": "munge", "slurmctld": "slurm-wlm", "slurmd": "slurm-wlm", "sbatch": "slurm-wlm"}
PATH = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/sbin"])
# Two jobs of one core at a time; a job that is cancelled has two seconds left; finished jobs stay in squeue.
CONFIG = """\
ClusterName=rubfric
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=0
SlurmdParameters=config_overrides
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ReturnToService=2
KillWait=2
MinJobAge=3600
NodeName={host} NodeAddr=127.0.0.1 NodeHostname={host} CPUs=2 RealMemory=12000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class NoCluster(RuntimeError):
    """A cluster that could not be started; the message says why."""


def missing_packages() -> list[str]:
    """Return the Debian packages that the cluster lacks."""
    return sorted({package for program, package in PACKAGES.items() if not shutil.which(program, path=PATH)})


@contextmanager
def one_node() -> Iterator[dict[str, str]]:
    """Run a cluster of one node and two cores; yield the environment in which SLURM's commands find it.

    Raises
    ------
    NoCluster
        Where packages are missing or a daemon does not come up.
    """
    if missing := missing_packages():
        raise NoCluster(f"the Debian packages {' and '.join(missing)} are missing: apt-get install {' '.join(missing)}")
    # Paths of sockets have room for about a hundred letters.
    with tempfile.TemporaryDirectory(prefix="slurm-", ignore_cleanup_errors=True) as name, ExitStack() as stack:
        folder = Path(name)
        folder.chmod(0o755)
        environment = os.environ | {"PATH": PATH, "SLURM_CONF": str(_configure(folder))}
        for variable in [name for name in environment if name.startswith(("SLURM_", "SBATCH_"))]:
            if variable != "SLURM_CONF":
                del environment[variable]
        for command in _daemons(folder):
            stack.enter_context(_daemon(command, folder, environment))
        _wait_until_idle(folder, environment)
        stack.callback(_cancel_all, environment)
        yield environment


def _configure(folder: Path) -> Path:
    """Write the key and the configuration; return where the latter is."""
    for name in ("state", "spool"):
        (folder / name).mkdir()
    key = folder / "munge.key"
    key.write_bytes(secrets.token_bytes(128))
    key.chmod(0o600)
    # Both ports are free now; nobody else is likely to take them within a second.
    with socket.socket() as first, socket.socket() as second:
        for port in (first, second):
            port.bind(("127.0.0.1", 0))
        controller, node = (port.getsockname()[1] for port in (first, second))
    config = folder / "slurm.conf"
    host = socket.gethostname().partition(".")[0]
    user = getpass.getuser()
    config.write_text(CONFIG.format(host=host, controller=controller, node=node, user=user, folder=folder))
    return config


def _daemons(folder: Path) -> list[list[str]]:
    """Return the commands of the daemons, in the foreground, in the order in which they have to start."""
    munge = [f"--{key}={folder}/munge.{end}" for key, end in (("socket", "socket"), ("key-file", "key"))]
    munge += [f"--{key}={folder}/munge.{end}" for key, end in (("pid-file", "pid"), ("seed-file", "seed"))]
    return [
        ["munged", "--foreground", "--force", *munge],
        ["slurmctld", "-D", "-c"],
        ["slurmd", "-D", "-c", "-N", socket.gethostname().partition(".")[0]],
    ]


@contextmanager
def _daemon(command: list[str], folder: Path, environment: dict[str, str]) -> Iterator[None]:
    """Run a daemon in the foreground of a process of ours, its words in a file of its name."""
    program = shutil.which(command[0], path=PATH) or command[0]
    with (folder / f"{command[0]}.said").open("wb") as said:
        process = subprocess.Popen([program, *command[1:]], env=environment, stdout=said, stderr=said)
    try:
        deadline = time.monotonic() + PATIENCE
        while command[0] == "munged" and not (folder / "munge.socket").exists():
            if process.poll() is not None or time.monotonic() > deadline:
                raise NoCluster(f"munged did not start: {(folder / 'munged.said').read_text()}")
            time.sleep(0.02)
        yield
    finally:
        process.terminate()
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait(PATIENCE)


def _wait_until_idle(folder: Path, environment: dict[str, str]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not _ask(["sinfo", "-h", "-o", "%T"], environment).startswith("idle"):
        if time.monotonic() > deadline:
            said = "\n".join(path.read_text()[-1000:] for path in sorted(folder.glob("slurm*.said")))
            raise NoCluster(f"no node became idle within {PATIENCE:g} s: {said}")
        time.sleep(0.1)


def _ask(command: list[str], environment: dict[str, str]) -> str:
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False).stdout


def _cancel_all(environment: dict[str, str]) -> None:
    """Leave no job behind: its processes would outlive the node."""
    _ask(["scancel", "--user", getpass.getuser()], environment)
    deadline = time.monotonic() + PATIENCE
    while _ask(["squeue", "-h", "-t", "R,CG"], environment) and time.monotonic() < deadline:
        time.sleep(0.1)


def main(arguments: list[str]) -> int:
    """Run a command on the cluster and return its exit code, or name what the cluster lacks."""
    if arguments == ["--missing"]:
        print(*missing_packages())
        return int(bool(missing_packages()))
    try:
        with one_node() as environment:
            return subprocess.run(arguments or ["sinfo"], env=environment, check=False).returncode
    except NoCluster as error:
        print(f"No cluster: {error}.", file=sys.stderr)
        return 1


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        sys.exit(main(sys.argv[1:]))
