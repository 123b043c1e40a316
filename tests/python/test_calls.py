"""Long calls: progress, cancelling, signals, threads. Times are printed, never asserted: the machine may be busy."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy

import vdbcage
from support import CREATURE, Case
from vdbcage import Mesh, make_cage

LONG = {"faces": 1000, "effort": "best"}  # seconds: a callback comes before it is done


def threads():
    """The number of threads of this process, those of C++ too."""
    return len(os.listdir("/proc/self/task"))


class CallsTest(Case):
    @classmethod
    def setUpClass(cls):
        cls.model = Mesh.read(CREATURE)

    def test_progress_is_told_in_the_callers_thread(self):
        calls = []

        def tell(stage, percent):
            calls.append((stage, percent, threading.get_ident()))

        cage = make_cage(self.model, faces=100, progress=tell)
        self.assertTrue(cage.check.bounding)
        self.assertGreater(len(calls), 0)
        for stage, percent, thread in calls:
            self.assertIn(stage, ["", *cage.report["stages"]])
            self.assertTrue(0 <= percent < 100)
            self.assertEqual(thread, threading.get_ident())
        percents = [percent for _, percent, _ in calls]
        self.assertEqual(percents, sorted(percents), "it goes back")

    def raised_by(self, answer, error):
        """What comes out of every long call whose callback does `answer`."""
        cage = make_cage(self.model, faces=50, effort="fast")
        points = numpy.tile(self.model.points, (100, 1))
        big = Mesh(self.model.points, numpy.tile(self.model.quads[:, :3], (200, 1)))
        for call in (lambda progress: make_cage(self.model, progress=progress, **LONG),
                     lambda progress: vdbcage.Pipeline(self.model).run(progress=progress, **LONG),
                     lambda progress: vdbcage.check_cage(cage, big, samples=10**8, progress=progress),
                     lambda progress: vdbcage.Binding(cage, points, "green", progress=progress)):
            asked = []

            def progress(stage, percent):
                asked.append(time.monotonic())
                return answer()

            with self.assertRaises(error) as caught:
                call(progress)
            print(f"{error.__name__} came out {1000 * (time.monotonic() - asked[0]):.0f} ms after the callback",
                  file=sys.stderr)
            self.assertEqual(len(asked), 1)
        return caught.exception

    def test_false_cancels(self):
        self.raised_by(lambda: False, vdbcage.Cancelled)

    def test_an_exception_comes_out_unchanged(self):
        mine = KeyError("mine")

        def fail():
            raise mine

        self.assertIs(self.raised_by(fail, KeyError), mine)

    def test_only_false_cancels(self):
        for answer in (None, 0, "", True):
            self.assertTrue(make_cage(self.model, faces=100, progress=lambda stage, percent: answer).check.bounding)

    def test_a_callback_of_the_wrong_form_is_an_error(self):
        self.refuses("progress: 5 is not allowed", make_cage, self.model, progress=5)
        with self.assertRaises(TypeError):
            make_cage(self.model, progress=lambda: None, **LONG)

    def test_ctrl_c_is_a_keyboard_interrupt(self):
        before = signal.signal(signal.SIGINT, signal.default_int_handler)  # ctest may run with it ignored
        self.addCleanup(signal.signal, signal.SIGINT, before)
        pipeline = vdbcage.Pipeline(self.model)
        for progress in (None, lambda stage, percent: None):
            begin, sent = threading.Event(), []

            def interrupt():
                before = threads()
                begin.set()
                while threads() == before:  # the call has not begun to work
                    time.sleep(0.001)
                sent.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)

            sender = threading.Thread(target=interrupt)
            sender.start()
            begin.wait()
            with self.assertRaises(KeyboardInterrupt):
                pipeline.run(progress=progress, **LONG)
                sender.join()
            sender.join()
            print(f"KeyboardInterrupt came out {1000 * (time.monotonic() - sent[0]):.0f} ms after the signal",
                  file=sys.stderr)

    def test_threads_make_cages_at_once(self):
        faces = [70, 80, 90, 100]
        expected = [make_cage(self.model, faces=count, effort="fast") for count in faces]
        made = [None] * len(faces)

        def make(i):
            made[i] = make_cage(self.model, faces=faces[i], effort="fast", progress=lambda stage, percent: None)

        threads = [threading.Thread(target=make, args=(i,)) for i in range(len(faces))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for cage, other in zip(made, expected):
            self.assertTrue(numpy.array_equal(cage.points, other.points))
            self.assertTrue(numpy.array_equal(cage.triangles, other.triangles))

    def test_other_threads_run_meanwhile(self):
        ran, done = threading.Event(), threading.Event()

        def run():
            done.wait()
            ran.set()

        thread = threading.Thread(target=run)
        thread.start()

        def tell(stage, percent):
            done.set()
            if ran.is_set():
                raise StopIteration

        with self.assertRaises(StopIteration):  # not if the lock is held: then the cage is done first
            make_cage(self.model, progress=tell, **LONG)
        thread.join()

    def test_no_thread_and_no_reference_is_left(self):
        class Stop(Exception):
            pass

        def stop(stage, percent):
            raise Stop

        make_cage(self.model, faces=100)
        before, references = threads(), (sys.getrefcount(stop), sys.getrefcount(self.model))
        rounds = 10 + (os.cpu_count() or 1)  # TBB may begin as many threads as there are cores, and keeps them
        for _ in range(rounds):
            with self.assertRaises(Stop):
                make_cage(self.model, progress=stop, **LONG)
        self.assertLess(threads(), before + rounds)
        self.assertEqual((sys.getrefcount(stop), sys.getrefcount(self.model)), references)

    def test_python_ends_while_daemon_threads_work(self):
        begin = """
import os, sys, threading, vdbcage
model = vdbcage.Mesh.read(sys.argv[1])
begun = threading.Event()
threading.excepthook = lambda error: None  # Python aborts where one that ends prints to standard error
def work():
    vdbcage.make_cage(model, faces=1000, effort="best", progress=lambda stage, percent: begun.set())
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
begun.wait()
"""
        fork = """
import atexit
child = os.fork()
if child:
    assert os.waitpid(child, 0)[1] == 0
else:
    atexit._run_exitfuncs()
    os._exit(0)  # with exit() log4cplus, which is OpenVDB's, waits for a thread that is not there
"""
        for program in (begin, begin + fork):
            for _ in range(3):
                subprocess.run([sys.executable, "-c", program, CREATURE], check=True, stderr=subprocess.DEVNULL)
