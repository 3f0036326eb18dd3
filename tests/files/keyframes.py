#!/usr/bin/python3
"""keyframes.py PETRI COUNT [FOLDER...]: tests that archives and state files do not depend on where a run was resumed.

Records COUNT random scripts, and each script in the folders, with three distances of keyframes. `petri archive verify` starts at
each keyframe, so it must find that the restored sessions compute the same. A random script is also run in two parts
with --state, whose file must have the same bytes as that of one run. The scripts have systems that appear, vanish, wait
or restart, particles that have no entry in the state yet, and counters that share their keys.
"""

import concurrent.futures
import pathlib
import random
import subprocess
import sys
import tempfile

FRAMES = 31
KEYFRAMES = ("1", "3", "7")
NUMBERS = ("frame", "frame/7", "sin(frame)", "1", "-2", "frame*frame", "0/(frame%3)", "1/0", "uniform(:u;frame)")
IDS = ("i", "i", "i", "i+frame%3", "(frame//4)*3+i", "i/2", "(:a;:b;:c;:d;:e)[i%5]", "i;1", "-i", "frame+i", "4-i", "100*i", "'n'")
PREFIXES = (":s0", ":s1", ":s2", ":s3", ":s0;1", ":s0;2", ":s1;:velocity", ":s0;:iteration", "'text'", "7")
TIMES = ("", "", "", " time=max(0;time-0.%d)" % 3, " time=0", " time=min(time;0.1)", " time=frame//4/10", " time=1/(frame%5)")
FORCES = ("!drag", "!gravity", "!random", "!collision", "!constant force=1", "!drag strength=3")


def condition(rng):
    return rng.choice(
        ("frame>%d" % rng.randint(1, 12), "frame<%d" % rng.randint(3, 12), "frame%%%d<%d" % (rng.randint(2, 23), rng.randint(1, 9)),
         "$(:s%d)>0" % rng.randint(0, 3)))


def bodies(rng, indent):
    """Returns lines with some particles or anchors."""
    lines = []
    for word in ("if " + condition(rng), "!group"):
        if rng.random() < 0.2:
            lines.append(indent + word)
            indent += "    "
    position = rng.choice(("", "i", "i;2", "1/0", "0/(frame%2)", rng.choice(NUMBERS)))
    velocity = rng.choice(("", "1", "1;2", rng.choice(NUMBERS)))
    lines.append(indent + "for i in " + rng.choice(("..5", "..1", "..3", "..frame%4", "..(4-frame//5)", "..70")))
    lines.append(indent + "    %s id=%s%s%s%s" % (
        rng.choice(("!particle",) * 5 + ("!anchor",)), rng.choice(IDS), position and " position=" + position,
        velocity and " velocity=" + velocity, rng.choice(("", "", " ease=2", " force=1", " mass=0", " mass=i"))))
    return lines


def random_script(seed):
    rng = random.Random(seed)
    lines = []
    for _ in range(rng.randint(1, 4)):
        indent = ""
        if rng.random() < 0.4:
            lines.append("if " + condition(rng))
            indent = "    "
        if rng.random() < 0.25:
            lines.append(indent + "!counter state=%s rate=%s" % (rng.choice((":c", ":s0;1", ":s1;0;:velocity", ":s2", "'k';2")), rng.choice(NUMBERS)))
            continue
        lines.append(indent + "!physics state=%s dimensions=%s%s%s" % (
            rng.choice(PREFIXES), rng.choice(("1", "2", "2", "3", "1+frame//5%3", "2/(frame%6)")), rng.choice(TIMES),
            rng.choice(("", "", "", " run=frame//%d" % rng.randint(2, 9)))))
        for _ in range(rng.randint(1, 3)):
            lines += bodies(rng, indent + "    ")
        if rng.random() < 0.5:
            lines.append(indent + "    " + rng.choice(FORCES))
    return "\n".join(lines) + "\n"


class Case:
    """A script, and a folder for its files."""

    def __init__(self, petri, folder, script, name):
        self.petri = petri
        self.folder = folder
        self.script = script
        self.name = name
        self.archives = 0
        self.failures = []

    def run(self, *words):
        command = [self.petri, *map(str, words)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, errors="replace", check=False)

    def fail(self, text):
        self.failures.append("%s: %s" % (self.name, text))

    def verify(self, every):
        archive = self.folder / (every + ".petri")
        recorded = self.run("run", self.script, "--frames", FRAMES, "--keyframe-every", every, "--archive", archive)
        if not archive.exists():
            return recorded
        verified = self.run("archive", "verify", archive)
        self.archives += 1
        # A script with an error has an archive without frames.
        if verified.returncode and "it has no frames" not in verified.stderr:
            self.fail("--keyframe-every %s: %s" % (every, verified.stdout + verified.stderr))
        return recorded

    def resume(self, cut):
        whole, parts = self.folder / "whole.state", self.folder / "parts.state"
        for file, frames in ((whole, FRAMES), (parts, cut), (parts, FRAMES - cut)):
            self.run("run", self.script, "--frames", frames, "--state", file)
        if whole.read_bytes() != parts.read_bytes():
            self.fail("resumed after frame %d, the state file differs:\n%s" % (cut - 1, self.script.read_text()))


def test_random(case, seed):
    case.script.write_text(random_script(seed))
    for every in KEYFRAMES:
        recorded = case.verify(every)
        if recorded.returncode:
            case.fail(recorded.stderr)
    case.resume(2 + seed % (FRAMES - 3))
    return case


def test_corpus(case):
    for every in KEYFRAMES:
        case.verify(every)
    return case


def has_state(path):
    text = path.read_text(errors="replace")
    return "!physics" in text or "!counter" in text


def main():
    petri, count, corpora = str(pathlib.Path(sys.argv[1]).resolve()), int(sys.argv[2]), sys.argv[3:]
    scripts = [path.resolve() for corpus in corpora for path in sorted(pathlib.Path(corpus).rglob("*.fl")) if has_state(path)]
    with tempfile.TemporaryDirectory() as root, concurrent.futures.ThreadPoolExecutor(4) as pool:
        folders = [pathlib.Path(root, str(i)) for i in range(count + len(scripts))]
        for folder in folders:
            folder.mkdir()
        tasks = [pool.submit(test_random, Case(petri, folders[i], folders[i] / "script.fl", "seed %d" % i), i) for i in range(count)]
        tasks += [pool.submit(test_corpus, Case(petri, folder, path, path)) for folder, path in zip(folders[count:], scripts)]
        cases = [task.result() for task in tasks]
    failures = [failure for case in cases for failure in case.failures]
    if any("built without SQLite" in failure for failure in failures):
        print("skipped: petri was built without SQLite")
        return 77
    for failure in failures:
        print("FAILED", failure)
    archives = sum(case.archives for case in cases)
    print("%d archives, %d failures" % (archives, len(failures)))
    return 1 if failures or archives < 3 * count else 0


sys.exit(main())
