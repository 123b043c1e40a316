"""GNU parallel over two hosts, which are this one by two names."""

import atexit
import csv
import os
import pathlib
import subprocess

from processes import FOLDER
from support import BAD, ENVIRONMENT, GOOD, QUICK, Case, changed, recipe

HOSTS = ("one", "two")


def make_key(file):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", file], check=True, env=ENVIRONMENT)


class Parallel(Case):
    environment = ENVIRONMENT | dict.fromkeys(("PARALLEL_SSH", "RSYNC_RSH"), f"ssh -F {FOLDER}/ssh_config")

    @classmethod
    def setUpClass(cls):
        for key in "host_key", "user_key":
            make_key(FOLDER / key)
        for host in HOSTS:
            # Never empty: --cleanup takes away empty folders, also one that another job is about to use.
            (FOLDER / host / ".parallel" / "tmp" / "kept").mkdir(parents=True)
            (FOLDER / f"sshd_{host}").write_text(f"""
HostKey {FOLDER}/host_key
AuthorizedKeysFile {FOLDER}/user_key.pub
StrictModes no
PermitRootLogin prohibit-password
UsePAM no
SetEnv PATH={ENVIRONMENT["PATH"]}
ForceCommand cd {FOLDER}/{host} && HOME=$PWD exec sh -c "$SSH_ORIGINAL_COMMAND"
""")
        # A server for each connection, which ends with it: nothing listens on a port.
        (FOLDER / "ssh_config").write_text(f"""
Host {" ".join(HOSTS)}
  ProxyCommand /usr/sbin/sshd -i -f {FOLDER}/sshd_%h
  IdentityFile {FOLDER}/user_key
  IdentitiesOnly yes
  UserKnownHostsFile {FOLDER}/known_hosts
  StrictHostKeyChecking accept-new
""")
        (FOLDER / "home").mkdir()
        rooms = pathlib.Path("/run/sshd")  # empty; root's sshd goes there to read what strangers send, and needs it
        if os.getuid() == 0 and not rooms.exists():
            rooms.mkdir(mode=0o755)
            atexit.register(rooms.rmdir)

    def log(self):
        """What GNU parallel's log has of each job that was run, in the order of the ends."""
        with open(self.folder / "log.txt", newline="") as file:
            return list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))

    def test_six_models_on_two_hosts(self):
        sending, sharing = recipe("GNU parallel over several hosts")
        script = changed(sending, "-o cages", QUICK)
        first = self.run_shell(script)
        self.assertEqual(first.returncode, 1, first.stdout)  # so many jobs failed
        self.assertIn(f"vdbcage: error: assets/{BAD}.obj: line ", first.stdout)
        jobs = self.log()
        self.assertEqual({job["Host"] for job in jobs}, set(HOSTS))
        self.assertEqual(sorted(job["Exitval"] for job in jobs), 5 * ["0"] + ["1"])
        self.expect_cages(GOOD)
        self.expect_bad_first()
        for host in HOSTS:
            self.assertEqual([path.name for path in (FOLDER / host).rglob("*")], [".parallel", "tmp", "kept"])

        before = self.results()
        self.mend()
        second = self.shell(script)
        self.assertEqual([job["Seq"] for job in self.log()[6:]], [job["Seq"] for job in jobs if job["Exitval"] == "1"])
        self.assertIn(f"cages/{BAD}.obj: 60 triangles, certified", second)
        self.assertEqual(self.results(), before)
        self.expect_cages((*GOOD, BAD))

        done = self.shell(sharing)  # here all hosts share a disk
        self.assertEqual(sorted(done.splitlines()), [f"cages/{name}.obj: was done before" for name in (BAD, *GOOD)])
        self.assertEqual(self.results(), before)

    def test_one_cage_on_two_hosts(self):
        corners = [(x, y, z) for x in (-1000, 1000) for y in (-1000, 1000) for z in (-1000, 1000)]
        faces = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
        (self.folder / "box.obj").write_text("".join("v %d %d %d\n" % corner for corner in corners) + faces)
        script = changed(recipe("GNU parallel over several hosts")[0], "jobs assets", "jobs --fit box.obj assets")
        script = changed(script, "-o cages", "-o cages --tight 0")
        script = changed(script, "--transferfile {1}", "--transferfile {1} --transferfile box.obj")
        first = self.run_shell(script)
        self.assertEqual(first.returncode, 1, first.stdout)
        self.assertIn(f"vdbcage: error: assets/{BAD}.obj: line ", first.stdout)
        self.assertEqual({job["Host"] for job in self.log()}, set(HOSTS))
        for name in GOOD:
            self.assertEqual((self.cages / f"{name}.obj").read_bytes(), (self.folder / "box.obj").read_bytes())
            self.assertIn('"bounding": true', (self.cages / f"{name}.json").read_text())
        for host in HOSTS:
            self.assertEqual([path.name for path in (FOLDER / host).rglob("*")], [".parallel", "tmp", "kept"])
        before = self.results()
        again = self.run_shell("sh jobs.txt")
        self.assertEqual(again.stdout.count(": was done before\n"), len(GOOD), again.stdout)
        self.assertEqual(self.results(), before)
