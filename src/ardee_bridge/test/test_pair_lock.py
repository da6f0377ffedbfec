# SPDX-License-Identifier: MIT
"""The lock that keeps header and data together among processes."""
import os
import signal
import subprocess
import sys
import threading

from ardee_bridge.udp import PairLock

HOLDER = """
import sys, time
from ardee_bridge.udp import PairLock
with PairLock(int(sys.argv[1]), is_shared=True):
    print("held", flush=True)
    time.sleep(600)
"""


def test_another_process_is_waited_for_until_it_dies():
    lock = PairLock.make()
    lock.is_shared = True
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(lock.file)],
        pass_fds=(lock.file,),
        stdout=subprocess.PIPE,
        text=True,
        env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)),
    ) as holder:
        assert holder.stdout.readline() == "held\n"
        taken = threading.Event()

        def take():
            with lock:
                taken.set()

        thread = threading.Thread(target=take)
        thread.start()
        assert not taken.wait(0.3)
        holder.send_signal(signal.SIGKILL)
        assert taken.wait(30.0)
        thread.join()
    os.close(lock.file)


def test_whoever_holds_it_goes_first_where_that_is_granted():
    lock = PairLock(os.memfd_create("test"), is_shared=True, priority=1)
    policies, first = [], []

    def hold():
        try:
            os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
            os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
            first.append(os.SCHED_RR)
        except PermissionError:
            first.append(os.SCHED_OTHER)
        for _ in range(2):
            with lock:
                policies.append(os.sched_getscheduler(0))
            policies.append(os.sched_getscheduler(0))

    thread = threading.Thread(target=hold)
    thread.start()
    thread.join()
    assert policies == first + [os.SCHED_OTHER] + first + [os.SCHED_OTHER]
    assert os.sched_getscheduler(0) == os.SCHED_OTHER
    os.close(lock.file)
