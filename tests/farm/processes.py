"""A folder for all that the tests write, and an end for all that they start, however they end."""

import atexit
import contextlib
import ctypes
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

_daemons = []
_PARENT_DEATH_SIGNAL, _CHILD_SUBREAPER = 1, 36  # <linux/prctl.h>


def _prctl(option, value):
    if ctypes.CDLL(None, use_errno=True).prctl(option, value, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl")


def _descendants():
    """The ids of all processes that came from this one."""
    children = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has ended
            parent = int(stat.read_text(errors="replace").rpartition(")")[2].split()[1])
            children.setdefault(parent, []).append(int(stat.parent.name))
    found = [os.getpid()]
    for pid in found:
        found += children.get(pid, [])
    return found[1:]


def _end_all():
    for asked in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
        signal.signal(asked, signal.SIG_IGN)
    with contextlib.suppress(ChildProcessError):  # there is none any more
        while True:
            for pid in _descendants():
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            os.wait()
    for daemon in _daemons:
        daemon.wait()  # has ended, and is told so
    shutil.rmtree(FOLDER)


def _run_in_child():
    """Goes on in a child. Where its parent, which is the process that others know, is killed, it still cleans up."""
    child = os.fork()
    if child == 0:
        _prctl(_PARENT_DEATH_SIGNAL, signal.SIGTERM)
        return
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the child gets it, too
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    os._exit(status if status >= 0 else 128 - status)


_run_in_child()
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="vdbcage-farm-"))
_prctl(_CHILD_SUBREAPER, 1)  # what daemons leave behind becomes ours, so none is missed
for _signal in signal.SIGTERM, signal.SIGHUP:
    signal.signal(_signal, signal.default_int_handler)
atexit.register(_end_all)


def start(words, log, environment):
    """Starts a daemon, which ends with the tests."""
    with open(log, "w") as out:
        _daemons.append(subprocess.Popen([str(word) for word in words], env=environment, stdin=subprocess.DEVNULL,
                                         stdout=out, stderr=out))


def wait_until(condition, what):
    """Returns what the condition returns, once that is true. The limit is for what never comes."""
    limit = time.monotonic() + 120
    while not (result := condition()):
        if ended := [daemon.args[0] for daemon in _daemons if daemon.poll() is not None]:
            raise TimeoutError(f"{what}, since {ended[0]} has ended")
        if time.monotonic() > limit:
            raise TimeoutError(what)
        time.sleep(0.05)
    return result
