"""Slurm arrays, on a cluster of one node that lives in a folder."""

import contextlib
import json
import os
import pwd
import re
import socket
import subprocess

from processes import FOLDER, start, wait_until
from support import BAD, ENVIRONMENT, GOOD, QUICK, Case, changed, recipe

CLUSTER = FOLDER / "slurm"
NODE = "node"
ENDED = ("COMPLETED", "FAILED", "CANCELLED")


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


def configuration():
    host = socket.gethostname().split(".")[0]  # slurmctld insists on it; that it has no address does not matter
    user = pwd.getpwuid(os.getuid()).pw_name
    controller_port, node_port = free_ports(2)
    return f"""
ClusterName=farm
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={CLUSTER}/munge.socket
CredType=cred/munge
StateSaveLocation={CLUSTER}/state
SlurmdSpoolDir={CLUSTER}/spool
SlurmctldPidFile={CLUSTER}/slurmctld.pid
SlurmdPidFile={CLUSTER}/slurmd.pid
SlurmctldLogFile={CLUSTER}/slurmctld.log
SlurmdLogFile={CLUSTER}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_min_interval=10000 # microseconds: the next job starts at once
SlurmdParameters=config_overrides # two processors, also on a machine that has one
ReturnToService=2
RequeueExit=75
NodeName={NODE} NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES
"""


def start_cluster(environment):
    for folder in CLUSTER, CLUSTER / "state", CLUSTER / "spool":
        folder.mkdir()
    key = CLUSTER / "munge.key"
    key.write_bytes(os.urandom(128))
    key.chmod(0o600)
    # Containers have none that may be written. Before 23.02 Slurm cannot be told so, but only looks where it needs them.
    version = subprocess.run(["slurmd", "-V"], env=environment, capture_output=True, text=True, check=True).stdout
    plugin = "disabled" if int(version.split()[1].split(".")[0]) >= 23 else "cgroup/v1"
    (CLUSTER / "cgroup.conf").write_text(f"CgroupPlugin={plugin}\n")
    file = CLUSTER / "slurm.conf"
    file.write_text(configuration())
    munged = [f"--{name}={CLUSTER}/munge.{end}" for name, end in (
        ("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))]
    start(["munged", "-F", "--force", "--num-threads=2", *munged], CLUSTER / "munged.out", environment)
    wait_until((CLUSTER / "munge.socket").is_socket, "munged does not start")
    start(["slurmctld", "-D", "-f", file], CLUSTER / "slurmctld.out", environment)
    start(["slurmd", "-D", "-f", file, "-N", NODE], CLUSTER / "slurmd.out", environment)

    def is_idle():
        told = subprocess.run(["sinfo", "-h", "-o", "%T"], env=environment, capture_output=True, text=True)
        return told.stdout == "idle\n"
    try:
        wait_until(is_idle, "Slurm does not start")
    except TimeoutError as error:
        logs = "\n".join(log.read_text(errors="replace") for log in CLUSTER.glob("*.log"))
        raise TimeoutError(f"{error}:\n{logs}") from None


def without_slurm(log):
    """The log of a task without what Slurm says there: of a /proc that is read-only, as in some containers."""
    return re.sub(r"(?m)^(\[\d{4}-\d\d-\d\dT[\d:.]+\]|slurmstepd-\w+: error: failed to open /proc/).*\n", "", log)


class Slurm(Case):
    environment = ENVIRONMENT | {"SLURM_CONF": str(CLUSTER / "slurm.conf")}

    @classmethod
    def setUpClass(cls):
        start_cluster(cls.environment)

    def setUp(self):
        super().setUp()
        self.script, self.commands = recipe("Slurm")
        self.write_script(self.script)

    def write_script(self, text):
        (self.folder / "farm.sh").write_text(text)

    def tasks(self, job):
        """What Slurm tells of the tasks of an array: a dictionary each."""
        told = self.shell(f"scontrol --oneliner show job {job}")
        tasks = [dict(word.split("=", 1) for word in line.split() if "=" in word) for line in told.splitlines()]
        return sorted(tasks, key=lambda task: int(task["ArrayTaskId"]))

    def wait_for(self, job, is_so=lambda task: False):
        """Waits until the only task of the array is so, or has ended; the task."""
        def found():
            task, = self.tasks(job)
            return task if is_so(task) or task["JobState"] in ENDED else None
        return wait_until(found, f"job {job} does not end")

    def submit_one(self, options):
        """Submits the documented array, of one model and with more options; the job."""
        commands = changed(changed(self.commands, "assets/*.obj", "assets/creature.obj"), "-o cages", options)
        return self.shell(changed(commands, "--wait", "--parsable")).strip()

    def test_six_models(self):
        commands = changed(self.commands, "-o cages", QUICK)
        first = self.run_shell(commands)
        self.assertEqual(first.returncode, 1, first.stdout)  # the highest of all
        job = first.stdout.split()[-1]
        lines = (self.folder / "jobs.txt").read_text().splitlines()
        for line, task in zip(lines, self.tasks(job), strict=True):
            is_bad = f"assets/{BAD}.obj" in line
            self.assertEqual((task["JobState"], task["ExitCode"], task["Restarts"]),
                             ("FAILED", "1:0", "0") if is_bad else ("COMPLETED", "0:0", "0"))
            log = without_slurm((self.cages / f"{task['ArrayTaskId']}.log").read_text())
            said = f"^vdbcage: error: assets/{BAD}.obj: line .*\n$" if is_bad else ", certified bounding,"
            self.assertRegex(log, said)
        self.expect_cages(GOOD)
        self.expect_bad_first()

        before = self.results()
        self.mend()
        self.shell(commands)
        for number, line in enumerate(lines, 1):
            log = (self.cages / f"{number}.log").read_text()
            self.assertIn("certified" if f"assets/{BAD}.obj" in line else ": was done before\n", log)
        self.assertEqual(self.results(), before)
        self.expect_cages((*GOOD, BAD))

    def test_a_cancelled_job_leaves_its_report(self):
        job = self.submit_one("-o cages --effort best --progress lines")
        log = self.cages / "1.log"
        wait_until(lambda: log.exists() and "Progress: " in log.read_text(), "the job does not work")
        self.shell(f"scancel {job}")
        task = self.wait_for(job)
        self.assertEqual((task["JobState"], task["ExitCode"]), ("CANCELLED", "143:0"))
        self.assertIn("vdbcage: error: cancelled\n", log.read_text())
        self.assertNotIn("100%", log.read_text())
        report = json.loads((self.cages / "creature.json").read_text())
        self.assertEqual((report["error"], report["exit_status"]), ("cancelled", 143))
        self.assertEqual(sorted(file.name for file in self.cages.iterdir()), ["1.log", "creature.json"])

    def test_too_little_memory_is_tried_again(self):
        self.write_script(changed(self.script, "\neval", "\nulimit -v 300000\neval"))
        job = self.submit_one("-o cages --faces 60 --effort fast --resolution 800 --memory off")
        task = self.wait_for(job, lambda task: task["Restarts"] != "0" and task["JobState"] == "PENDING")
        self.assertEqual((task["JobState"], task["Restarts"]), ("PENDING", "1"))
        self.shell(f"scancel {job}")  # it would be tried again some minutes later
        self.assertEqual(self.wait_for(job)["JobState"], "CANCELLED")
        self.assertIn("vdbcage: error: not enough memory\n", (self.cages / "1.log").read_text())
        report = json.loads((self.cages / "creature.json").read_text())
        self.assertEqual((report["error"], report["exit_status"]), ("not enough memory", 75))
        self.assertEqual(sorted(file.name for file in self.cages.iterdir()), ["1.log", "creature.json"])
