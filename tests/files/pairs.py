#!/usr/bin/python3
"""pairs.py PETRI COUNT [SEED]: runs pairs of commands at the same time on the same files.

The files are a script, its golden, a state, an archive, a cache and tables. After each of COUNT pairs, every file must be
valid: a command that succeeds has left a file that the next commands accept. In every third pair, one of the commands
is killed with SIGKILL after a random time. No command may hang, crash or be ended by a signal that it was not sent.
"""

import itertools
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

SCRIPT = """%pragma fps 25
let SEED=SEED or 1
let shift=read('shift.txt')
!physics state=:p dimensions=2
    for i in ..40
        !particle id=i position=9*uniform(:p;SEED)[2*i;2*i+1] radius=0.5
    !collision
    !random strength=1
!counter state=:n rate=SEED
!window size=40
    !canvas
        for i in ..40
            !ellipse point=4*$(:p;i) radius=2 fill=true
"""
SWEEP = "sweep dish.fl --seeds 3 --frames 4 --metric x=$(:p;3)[0] --jobs 2"
COMMANDS = {
    "save": "run dish.fl --frames 9 --save-every 2 --state s.state",
    "resume": "run dish.fl --frames 3 --state s.state",
    "follow": "run dish.fl --frames 9 --trajectory way.csv",
    "record": "run dish.fl --frames 60 --keyframe-every 7 --archive r.petri",
    "table": SWEEP + " --cache cache -o t.csv",
    "cached": SWEEP + " --cache cache",
    "again": SWEEP + " --cache cache --verify-cache 100%",
    "shard": SWEEP + " --cache cache -o parts.csv --shard 1/2",
    "update": "test --update dish.fl",
    "test": "test dish.fl",
    "format": "fmt dish.fl",
    "check": "check dish.fl",
    "draw": "render dish.fl --frames 2 -o p.png",
    "info": "archive info r.petri",
    "verify": "archive verify r.petri",
    "replay": "run r.petri --frames 5",
    "unpack": "archive unpack r.petri unpacked",
    "compare": "diff r.petri dish.fl",
    "differ": "diff s.state dish.fl",
}


class Pairs:
    def __init__(self, petri, folder, rng):
        self.petri = petri
        self.folder = pathlib.Path(folder)
        self.rng = rng
        self.failures = 0
        self.script = SCRIPT

    def start(self, words):
        return subprocess.Popen([self.petri, *words], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, errors="replace")

    def run(self, command):
        process = self.start(command.split())
        out, err = process.communicate(timeout=200)
        return process.returncode, out, err

    def expect(self, good, pair, text):
        if not good:
            self.failures += 1
            print("FAILED %s: %s" % (" and ".join(pair), text))

    def run_pair(self, pair, killed):
        """Returns the exit statuses; None: killed."""
        processes = [self.start(COMMANDS[name].split()) for name in pair]
        if killed is not None:
            time.sleep(self.rng.random() ** 2 * 0.2)
            processes[killed].kill()
        statuses = []
        for number, process in enumerate(processes):
            try:
                _, err = process.communicate(timeout=200)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                self.expect(False, pair, "%s does not end" % pair[number])
                statuses.append(None)
                continue
            status = process.returncode
            if number == killed and status == -9:
                statuses.append(None)
                continue
            statuses.append(status)
            self.expect(status in (0, 1, 2) and "Sanitizer" not in err, pair, "%s: status %d: %s" % (pair[number], status, err))
        return statuses

    def succeeded(self, pair, statuses, name):
        return any(name == command and status == 0 for command, status in zip(pair, statuses))

    def judge(self, pair, statuses, table):
        status, _, err = self.run("run dish.fl --frames 0 --state s.state")
        self.expect(status == 0, pair, "the state is damaged: " + err)
        status, out, err = self.run(COMMANDS["again"])
        self.expect(status == 0 and "damaged" not in err and out == table, pair, "the cache is damaged: " + out + err)
        if self.succeeded(pair, statuses, "table"):
            self.expect((self.folder / "t.csv").read_text() == table, pair, "the table differs")
        status, out, _ = self.run("test dish.fl")
        self.expect(status == 0, pair, "the golden is damaged: " + out)
        self.expect((self.folder / "dish.fl").read_text() == self.script, pair, "the script has changed")
        lines = (self.folder / "way.csv").read_text().splitlines()
        self.expect(len(lines) % 40 == 1 and len({line.count(",") for line in lines}) == 1, pair, "the trajectory is damaged")
        if self.succeeded(pair, statuses, "record") or "record" not in pair:
            status, out, err = self.run("archive verify r.petri")
            self.expect(status == 0, pair, "the archive is damaged: " + out + err)
        else:
            self.expect(None in statuses, pair, "no recording has succeeded")
            self.run(COMMANDS["record"])  # for the next pair
        if None not in statuses:
            left = [path.name for path in self.folder.rglob("*.tmp")]
            self.expect(not left, pair, "files remain: %s" % left)


def main():
    petri, count = str(pathlib.Path(sys.argv[1]).resolve()), int(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        pairs = Pairs(petri, folder, rng)
        (pairs.folder / "dish.fl").write_text(SCRIPT)
        (pairs.folder / "shift.txt").write_text("5")
        (pairs.folder / "dish.golden").write_text("# run --frames 9 --print state\n")
        for name in ("format", "save", "follow", "record", "update"):
            status, out, err = pairs.run(COMMANDS[name])
            if "built without SQLite" in err:
                print("skipped:", err)
                return 77
            pairs.expect(status == 0, (name,), out + err)
        pairs.script = (pairs.folder / "dish.fl").read_text()
        table = pairs.run(SWEEP)[1]
        pairs.expect(pairs.run(COMMANDS["cached"])[1] == table, ("cached",), "the table differs")
        names = list(COMMANDS)
        if pairs.run(COMMANDS["draw"])[0] != 0:
            names.remove("draw")  # a build without Cairo
        every = list(itertools.combinations_with_replacement(names, 2))
        rng.shuffle(every)
        for number in range(count):
            pair = every[number % len(every)]
            statuses = pairs.run_pair(pair, rng.randrange(2) if number % 3 == 2 else None)
            pairs.judge(pair, statuses, table)
            shutil.rmtree(pairs.folder / "unpacked", ignore_errors=True)
        print("%d pairs, %d failures" % (count, pairs.failures))
    return 1 if pairs.failures else 0


sys.exit(main())
