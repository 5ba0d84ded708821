#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A batch in four shards on a real Slurm, one of whose nodes dies in the middle, makes what one program makes.

Usage: slurm_test.py SCRIPT PROGRAM, with packaging/slurm/pellucid-batch.sh and pellucid-cli. The exit status is 77
where Slurm cannot run. All daemons run in namespaces of their own, with a private network, and end with this program however
it ends.
"""
import contextlib
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

SKIP = 77
STUDIES = 200
SHARDS = 4
CONTROLLER_PORT, FIRST_NODE_PORT = 26817, 26818  # of the private network
SETTLING_S = 30  # for a daemon or a task to start, also on a busy machine
RENDERING_S = 300  # for all studies
RECIPE = {
    "recipe": 1,
    "outputs": [
        {"name": "front", "view": "front", "format": "npy", "size": [48, 48], "tolerance": 0.01},
        {"name": "left", "view": "left", "format": "dicom", "size": [48, 48], "tolerance": 0.01},
    ],
}


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIP)


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def output(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def wait_for(what, condition, seconds=SETTLING_S):
    """The first true value of the condition."""
    end = time.monotonic() + seconds
    while not (value := condition()):
        check(time.monotonic() < end, f"not within {seconds} s: {what}")
        time.sleep(0.1)  # between two looks at a program that reports nothing
    return value


# --- Studies


def write_studies(program, folder):
    """Copies of a few phantoms, each with UIDs and voxels of its own: many times as fast as that many phantoms."""
    uid = re.compile(rb"(1\.2\.276\.0\.7230010\.3\.1\.\d\.\d+\.\d+\.)\d{10}(\.\d+)")  # DCMTK's; the digits are a time
    originals = []
    for kind in ("head", "chest", "ellipsoids", "metal"):
        original = folder.parent / f"phantom-{kind}"
        output(program, "phantom", original, "--kind", kind, "--size", "24x24x8")
        originals.append([file.read_bytes() for file in sorted(original.iterdir())])
    middle = 2 * (24 * 12 + 12)  # bytes from the end of a slice, which its pixels end
    for n in range(STUDIES):
        study = folder / f"{n:03}"
        study.mkdir(parents=True)
        for number, slice_ in enumerate(originals[n % len(originals)]):
            copy, replaced = uid.subn(rb"\g<1>%010d\2" % (10**9 + n), slice_)
            check(replaced >= 3, "a phantom's UIDs are not those of DCMTK")
            value = (500 + 5 * n).to_bytes(2, "little")
            (study / f"{number}.dcm").write_bytes(copy[:-middle] + 4 * value + copy[len(copy) - middle + 8 :])


# --- Slurm


class Slurm:
    """One controller and a node for each shard, all on this machine."""

    def __init__(self, folder):
        self.folder = folder
        self.nodes = {f"n{n}": None for n in range(SHARDS)}
        for name in ("run", "log", "state", "spool"):
            (folder / name).mkdir()
        key = folder / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        host = socket.gethostname().split(".")[0]
        run, log = folder / "run", folder / "log"
        self.munged = subprocess.Popen(
            ["munged", "--foreground", f"--key-file={key}", f"--socket={run}/munge.s", f"--pid-file={run}/munge.pid",
             f"--seed-file={run}/munge.seed", f"--log-file={log}/munge.log", "--num-threads=1"],
            stdout=subprocess.DEVNULL, stderr=(log / "munged").open("w"))
        nodes = "\n".join(
            f"NodeName={name} NodeHostname={name} NodeAddr=127.0.0.1 Port={self.port(name)} CPUs=1 RealMemory=1000"
            for name in self.nodes)
        # The address beside the host's name avoids DNS. config_overrides: a machine with fewer processors than nodes
        # will do. Limits are short, because all daemons are near each other.
        (folder / "slurm.conf").write_text(f"""\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={CONTROLLER_PORT}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={run}/munge.s
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={run}/controller.pid
SlurmdPidFile={run}/%n.pid
SlurmctldLogFile={log}/controller.log
SlurmdLogFile={log}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerParameters=bf_interval=1,sched_interval=1
ReturnToService=2
SlurmdTimeout=10
MessageTimeout=5
BatchStartTimeout=10
KillWait=2
{nodes}
PartitionName=all Nodes=ALL Default=YES State=UP
""")
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        wait_for("munged", (run / "munge.s").exists)
        self.controller = self._start("slurmctld", "-D")
        # Nodes that do not find the controller wait for seconds before they try again.
        wait_for("slurmctld", lambda: listens(CONTROLLER_PORT))
        for name in self.nodes:
            self.start(name)

    def port(self, node):
        return FIRST_NODE_PORT + list(self.nodes).index(node)

    def _start(self, *command):
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start(self, node):
        # Each node has its own host name, as the batch sees it.
        self.nodes[node] = self._start(
            "unshare", "--uts", "sh", "-c", f"hostname {node} && exec slurmd -D -N {node}")

    def idle(self):
        """The nodes that wait for work; none while the controller does not answer."""
        answer = subprocess.run(["sinfo", "-h", "-N", "-t", "idle", "-r", "-o", "%N"], capture_output=True, text=True)
        return set(answer.stdout.split())

    def tasks(self):
        """Job, state and node of each task that has not ended."""
        tasks = {}
        for line in output("squeue", "-h", "-r", "-o", "%A|%K|%T|%N").splitlines():
            job, task, state, node = line.split("|")
            tasks[int(task)] = {"job": job, "state": state, "node": node}
        return tasks

    def ended(self, array):
        """What Slurm says of each task of an array."""
        jobs = {}
        for line in output("scontrol", "-o", "show", "job", array).splitlines():
            fields = dict(field.split("=", 1) for field in line.split() if "=" in field)
            jobs[int(fields["ArrayTaskId"])] = fields
        return jobs

    def kill(self, node, job):
        """What a power cut does: the daemon, the job's supervisor and all processes of the job end at once."""
        daemon = self.nodes[node]
        daemon.kill()
        daemon.wait()
        commands, parents = {}, {}
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):  # it has ended
                commands[int(process.name)] = (process / "cmdline").read_bytes().decode(errors="replace")
                parents[int(process.name)] = int((process / "stat").read_text().rpartition(")")[2].split()[1])
        victims = [pid for pid, command in commands.items() if command.startswith(f"slurmstepd: [{job}.")]
        check(len(victims) == 1, f"one supervisor of job {job}: {victims}")
        for pid in victims:  # grows
            victims += [child for child, parent in parents.items() if parent == pid]
        check(any("pellucid-cli" in commands[pid] for pid in victims), "the job runs the program")
        for pid in victims:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        wait_for("the end of the killed processes", lambda: not any(map(is_running, victims)))


def listens(port):
    with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port)):
        return True
    return False


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


# --- Results


def done_in(folder):
    return {record.parent.name for record in folder.glob("*/done.json")}


def contents(folder):
    """What each study's folder has: digests of files, and the record without its times."""
    studies = {}
    for study in folder.iterdir():
        files = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in study.iterdir()}
        record = json.loads((study / "done.json").read_text())
        del record["seconds"]
        files["done.json"] = record
        studies[study.name] = files
    return studies


def rendered_in(log):
    """The studies that a task reports, in their order, and its last line."""
    lines = log.read_text().splitlines()
    studies = [m[1] for m in (re.match(r"\d+ of \d+: (\S+): ", line) for line in lines) if m]
    return studies, lines[-1]


def counts(line):
    """Of a last line: studies rendered, studies of the shard, studies that were done before."""
    match = re.match(r"(\d+) of (\d+) stud(?:y|ies) done(?:, (\d+) done before)?; [\d.]+ s$", line)
    check(match, f"not the end of a batch: {line}")
    return int(match[1]), int(match[2]), int(match[3] or 0)


def test(slurm, script, program, work):
    begin = time.monotonic()

    def tell(what):
        print(f"{time.monotonic() - begin:6.1f} s: {what}", flush=True)

    recipe, studies, logs = work / "recipe.json", work / "studies", work / "logs"
    recipe.write_text(json.dumps(RECIPE))
    logs.mkdir()
    write_studies(program, studies)
    tell(f"{STUDIES} studies are written")
    output(program, "batch", recipe, studies, "--out", work / "one")
    truth = contents(work / "one")
    check(len(truth) == STUDIES, f"one program makes {len(truth)} studies")
    check(len({json.dumps(study, sort_keys=True) for study in truth.values()}) == STUDIES, "studies look the same")
    tell("one program has rendered them")

    out = work / "shards"
    out.mkdir()
    arguments = [SHARDS, recipe, studies, "--out", out, "--jobs", 1]
    array = output(script, *map(str, arguments), cwd=logs).split()[-1]
    log = lambda task, of=array: logs / f"pellucid-batch-{of}_{task}.log"

    # The node of the task that has got furthest dies in the middle.
    def task_in_the_middle():
        running = {task: about for task, about in slurm.tasks().items() if about["state"] == "RUNNING"}
        reported = {task: len(rendered_in(log(task))[0]) for task in running if log(task).exists()
                    and log(task).stat().st_size}
        furthest = max(reported, key=reported.get, default=None)
        if furthest is not None and reported[furthest] >= STUDIES // SHARDS // 3:
            return furthest, running[furthest]
        return None

    killed, about = wait_for("a task in the middle", task_in_the_middle, RENDERING_S)
    node, job = about["node"], about["job"]
    slurm.kill(node, job)
    leftovers = [path.name for path in out.glob(".pellucid-*")]
    before = len(rendered_in(log(killed))[0])
    tell(f"{node} died with task {killed} after {before} studies, {len(done_in(out))} of all; "
         f"unfinished folders at this moment: {len(leftovers)}")

    # Slurm notices a dead node and starts its job elsewhere by itself, but that takes three minutes. The administrator
    # who restarts the node can do it at once.
    slurm.start(node)
    wait_for("the restarted node", lambda: listens(slurm.port(node)))
    job_of_task = f"{array}_{killed}"  # the job of the last task alone would stand for the whole array
    output("scontrol", "requeue", job_of_task)
    # The node refuses each start of the job that is not in a later second than the end of its first run.
    wait_for("the end of the first run", lambda: node in slurm.idle())
    time.sleep(1.1)

    def runs_again():
        state = slurm.tasks().get(killed, {"state": "ENDED"})
        if state["state"] == "PENDING":
            # On the same node: only programs there remove what it has left unfinished.
            subprocess.run(["scontrol", "update", f"jobid={job_of_task}", f"reqnodelist={node}", "starttime=now"],
                           capture_output=True)
        return state["state"] in ("RUNNING", "ENDED")

    wait_for("the second run of the task", runs_again)
    tell(f"task {killed} runs again")
    wait_for("the end of all tasks", lambda: not slurm.tasks(), RENDERING_S)
    tell("all tasks have ended")

    for task, fields in slurm.ended(array).items():
        check(fields["JobState"] == "COMPLETED" and fields["ExitCode"] == "0:0",
              f"task {task}: {fields['JobState']}, {fields['ExitCode']}")
        check(fields["Restarts"] == str(int(task == killed)), f"task {task} restarted {fields['Restarts']} times")

    # The union is what one program makes.
    remains = [path.name for path in out.iterdir() if path.name.startswith(".")]
    check(not remains, f"unfinished folders remain: {remains}")
    union = contents(out)
    check(union.keys() == truth.keys(), f"missing: {truth.keys() - union.keys()}, more: {union.keys() - truth.keys()}")
    for study, files in truth.items():
        check(union[study] == files, f"{study}: {union[study]} is not {files}")

    # Each study is rendered once. The killed program may have put one result in place without reporting it.
    reports, sizes = [], []
    for task in range(SHARDS):
        rendered, last = rendered_in(log(task))
        made, size, skipped = counts(last)
        check(made + skipped == size, f"task {task}: {last}")
        check(skipped == 0 or task == killed, f"task {task} found results: {last}")
        reports += rendered
        sizes.append(size)
        if task == killed:
            check(before <= skipped <= before + 1, f"{before} studies were reported before: {last}")
    check(sum(sizes) == STUDIES and min(sizes) > 0, f"shards of {sizes} studies")
    check(len(set(reports)) == len(reports), "a study was rendered twice")
    check(STUDIES - 1 <= len(reports), f"{len(reports)} studies were reported")

    # A task that is submitted again alone has the same studies.
    task = SHARDS - 1
    lost = rendered_in(log(task))[0][:2]
    for study in lost:
        shutil.rmtree(out / study)
    again = output("sbatch", f"--array={task}", script, *map(str, arguments), cwd=logs).split()[-1]
    wait_for("the end of the task", lambda: not slurm.tasks(), RENDERING_S)
    rendered, last = rendered_in(log(task, again))
    check(rendered == sorted(lost) and counts(last) == (len(lost), sizes[task], sizes[task] - len(lost)),
          f"{lost} were lost: {rendered}, {last}")
    check(contents(out) == truth, "what was rendered again is the same")
    tell(f"shards of {sizes} studies: all as one program makes them")


def missing():
    """Why this machine cannot run the test, if it cannot."""
    if os.geteuid() != 0:
        return "only root can start the daemons of Slurm and their namespaces"
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    needed = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol", "unshare", "setpriv", "ip")
    missing = [program for program in needed if not shutil.which(program)]
    if missing:
        return f"not installed: {', '.join(missing)}"
    tried = subprocess.run([*NAMESPACES, "true"], capture_output=True, text=True)
    return f"no namespaces: {tried.stderr.strip()}" if tried.returncode else None


# The end of this program ends the first process of the namespace, and that one ends all others.
NAMESPACES = ["setpriv", "--pdeathsig", "KILL",
              "unshare", "--net", "--uts", "--pid", "--fork", "--kill-child", "--mount-proc"]


def run_inside(script, program, work):
    """The test, as the first process of its namespaces."""
    # Slurm looks for its host by getaddrinfo, which needs an interface beside that of the machine itself.
    interface = subprocess.run(
        "ip link set lo up && { ip link add d0 type dummy || ip link add d0 type veth peer name d1; } &&"
        "ip addr add 10.99.0.1/24 dev d0 && ip link set d0 up", shell=True, capture_output=True, text=True)
    if interface.returncode:
        skip(f"no network interface can be made: {interface.stderr.strip()}")
    os.environ.update(PELLUCID_CLI=program, HOME=str(work), SLURM_TMPDIR=str(work / "node"))
    (work / "node").mkdir()
    (work / "slurm").mkdir()
    try:
        try:
            slurm = Slurm(work / "slurm")
            wait_for("idle nodes", lambda: slurm.idle() == set(slurm.nodes))
        except (AssertionError, OSError) as error:
            print_logs(work)
            skip(f"the daemons do not start: {error}")
        test(slurm, script, program, work)
    except BaseException as error:
        if not isinstance(error, SystemExit):
            print_logs(work)
        raise


def print_logs(work):
    for file in sorted([*work.glob("slurm/log/*"), *work.glob("logs/*")]):
        print(f"--- {file.name}")
        print("\n".join(file.read_text(errors="replace").splitlines()[-20:]))


def main():
    if sys.argv[1] == "--inside":
        run_inside(sys.argv[2], sys.argv[3], pathlib.Path(sys.argv[4]))
        return
    if reason := missing():
        skip(reason)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # the folder is removed, too
    work = tempfile.mkdtemp(prefix="pellucid-slurm-")
    try:
        os.chmod(work, 0o755)  # munge requires it
        arguments = [os.path.abspath(path) for path in sys.argv[1:3]]
        status = subprocess.run([*NAMESPACES, sys.executable, __file__, "--inside", *arguments, work]).returncode
    finally:
        shutil.rmtree(work, ignore_errors=True)
        if os.path.exists(work):  # processes that are just being killed have written to it meanwhile
            wait_for("the end of all processes", lambda: shutil.rmtree(work, ignore_errors=True) or
                     not os.path.exists(work))
    sys.exit(status)


if __name__ == "__main__":
    main()
