#!/usr/bin/env python3
"""laws.py PETRI: laws of the prompt's commands: going back to a condition, breaks, prev(), shortened commands, and moved particles."""
import math
import os
import random
import re
import subprocess
import sys
import tempfile

PETRI = os.path.abspath(sys.argv[1])
FRAMES = 160
SCRIPT = """let SPIN=SPIN or 3
!counter state=:c rate=SPIN
!physics state=:p dimensions=2
    for i in ..5
        !particle id=i position=9*i;2*i velocity=3-i;i radius=2 mass=i+1
    !collision
    !random strength=40
    !barrier position=-20;0 normal=1;0
!physics state=:q dimensions=1 time=beat
    !particle id=:one position=1 velocity=2
    !anchor id=:home position=0
    !distance from=:home to=:one strength=9 fixed=0
"""
EXPRESSIONS = [
    "$:c", "floor($:c*7)", "$(:p;2)", "$(:p;0;:velocity)[0] > 0", "hypot($(:p;1;:velocity))", "$(:q;:one) < 0", "frame % 9",
    "'text' if $(:q;:one) > 0.5 else null", "speed(3) > speed(1)", "$:nothing",
]
CONDITIONS = [
    "$:c*37 % 1 < 0.1", "$(:q;:one) < -0.8", "speed(0) > 4", "speed(2) > prev(speed(2))", "prev($(:q;:one)) * $(:q;:one) < 0",
    "changes floor($:c*2)", "changes $(:q;:one) > 0", "changes speed(3) > speed(1)", "frame == 3", "frame == 0", "false",
]


def printed(inputs, folder):
    """Returns the output of each input, each of which is followed by one that prints a mark."""
    lines = "".join(f"{line}\n'MARK'\n" for line in inputs)
    done = subprocess.run([PETRI, "repl", "s.fl"], input="func speed(i)\n    hypot($(:p;i;:velocity))\n\n" + lines, cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    text = re.sub(r"^(petri> |@\d+> |\.\.\. ).*\n", "", done.stdout, flags=re.M)
    parts = re.split(r"^'MARK'\n", text, flags=re.M)
    return [part.strip() for part in parts[: len(inputs)]]


def frame_of(text):
    found = re.search(r"^@(-?\d+) ", text, flags=re.M)
    return int(found.group(1)) if found else None


def values_of(expressions, folder):
    """Returns the values of expressions in each frame, stepping forward."""
    inputs = [line for _ in range(FRAMES) for line in [".step", *expressions]]
    lines = printed(inputs, folder)
    width = len(expressions) + 1
    return {text: [lines[frame * width + 1 + i] for frame in range(FRAMES)] for i, text in enumerate(expressions)}


def truth(folder):
    """Returns for each condition the frames in which it is true, from values of its parts in frames computed forward."""
    plain = [text for text in CONDITIONS if "prev" not in text and not text.startswith("changes")]
    changing = {text: text[len("changes "):] for text in CONDITIONS if text.startswith("changes ")}
    parts = ["speed(2)", "$(:q;:one)", *changing.values()]
    values = values_of([f"1 if ({text}) else 0" for text in plain] + parts, folder)
    found = {text: [frame for frame in range(FRAMES) if values[f"1 if ({text}) else 0"][frame] == "1"] for text in plain}
    for text, part in changing.items():
        found[text] = [frame for frame in range(1, FRAMES) if values[part][frame] != values[part][frame - 1]]
    speed, one = ([math.nan if x == "null" else float(x) for x in values[text]] for text in ("speed(2)", "$(:q;:one)"))
    found["speed(2) > prev(speed(2))"] = [frame for frame in range(1, FRAMES) if speed[frame] > speed[frame - 1]]
    found["prev($(:q;:one)) * $(:q;:one) < 0"] = [frame for frame in range(1, FRAMES) if one[frame] * one[frame - 1] < 0]
    return found


def check(what, got, expected):
    check.count += 1
    if got != expected:
        check.failed += 1
        print(f"FAIL {what}: got {got!r}, expected {expected!r}")


check.count = check.failed = 0


def laws_of_conditions(folder, numbers):
    found = truth(folder)
    for text in CONDITIONS:
        at = [numbers.randrange(20, FRAMES) for _ in range(3)]
        inputs = [line for frame in at for line in [f".goto {frame}", f".back until {text}", "frame"]]
        lines = printed(inputs, folder)
        for i, frame in enumerate(at):
            # Before frame 0 nothing is known, so that prev() is null there and comparisons with it differ.
            before = [other for other in found[text] if 0 < other < frame]
            if before:
                check(f".back until {text} at {frame}", frame_of(lines[3 * i + 1]), before[-1])
            elif "frame == 0" not in text and "prev" not in text:
                check(f".back until {text} at {frame}", lines[3 * i + 2], str(frame))
        start, count = numbers.randrange(1, 40), numbers.randrange(30, 100)
        end = start + count
        lines = printed([f".goto {start}", f".break {text}", f".step {count}", ".goto " + str(end), f".back {count}"], folder)
        after = [frame for frame in found[text] if start < frame <= end]
        check(f".break {text}, .step {count} from {start}", frame_of(lines[2].splitlines()[-1 - (len(after) > 0)]),
              after[0] if after else end)
        before = [frame for frame in found[text] if start <= frame < end]
        check(f".break {text}, .back {count} from {end}", frame_of(lines[4]), before[-1] if before else start)
        check(f"the note of .break {text}", "stopped by .break" in lines[4], bool(before))


def law_of_previous_values(folder, numbers):
    for text in EXPRESSIONS:
        frame = numbers.randrange(2, FRAMES)
        lines = printed([f".goto {frame}", f"prev({text})", ".set SPIN 4", f"prev({text})", ".back", text, ".step",
                         f"prev({text})"], folder)
        check(f"prev({text}) in {frame}", lines[1], lines[5])
        check(f"prev({text}) in {frame} after .set", lines[3], lines[5])
        check(f"prev({text}) in {frame} after .back and .step", lines[7], lines[5])


def law_of_abbreviations(folder):
    names = re.findall(r"^(\.[a-z]+)(?: \S.*?)? {2,}\S", printed([".help"], folder)[0], flags=re.M)
    short = {".s": ".step", ".b": ".back", ".u": ".until", ".r": ".run", ".h": ".help", ".q": ".quit"}
    words = sorted({name[:length] for name in names for length in range(2, len(name) + 1)})
    lines = printed([f".help {word}" for word in words] + [f"{word} 1+" for word in words if word not in names], folder)
    whole = dict(zip(names, printed([f".help {name}" for name in names], folder)))
    helps, errors = lines[: len(words)], dict(zip([word for word in words if word not in names], lines[len(words):]))
    for word, text in zip(words, helps):
        begins = [name for name in names if name.startswith(word)]
        meant = word if word in names else short.get(word) or (begins[0] if len(begins) == 1 else None)
        if meant:
            check(f".help {word}", text, whole[meant] if word not in (".h", ".q") else text)
        else:
            check(word, errors[word], f"petri: ambiguous command: '{word}' begins {', '.join(begins)}")


def random_inputs(numbers, count):
    """Returns inputs that go back and forth, move particles and set parameters."""
    vector = lambda: ";".join(str(numbers.randrange(-40, 40) / 4) for _ in range(2))
    makers = [
        lambda: f".step {numbers.randrange(1, 20)}", lambda: f".back {numbers.randrange(1, 12)}", lambda: ".step",
        lambda: f".goto {numbers.randrange(0, 60)}", lambda: f".move (:p;{numbers.randrange(5)}) position={vector()}",
        lambda: f".move {numbers.randrange(5)} velocity={vector()} position=$(:p;0)+{numbers.randrange(1, 9)}",
        lambda: f".move :one velocity={numbers.randrange(9)}", lambda: f".set SPIN {numbers.randrange(1, 9)}",
        lambda: f".until $:c > {numbers.randrange(1, 5)} --limit 30", lambda: ".trust $(:p;0)", lambda: ".drop",
        lambda: f"!physics state=:r dimensions=1\n    for i in ..{numbers.randrange(1, 4)}\n        !particle id=i velocity=SPIN\n",
    ]
    return [".step 3"] + [numbers.choice(makers)() for _ in range(count)]


def law_of_moves(folder, numbers):
    """A move is a part of its frame: it happens again whenever the frame is computed again, and changes nothing else."""
    for _ in range(20):
        start, ago, on = numbers.randrange(1, 60), numbers.randrange(1, 70), numbers.randrange(1, 40)
        which, vector = numbers.randrange(5), f"{numbers.randrange(-9, 9)};{numbers.randrange(99) / 8}"
        here = min(ago, start + 1)
        lines = printed([
            f".goto {start}", ".state", f".move {which} position=$(:p;{which}) velocity=$(:p;{which};:velocity)", ".state",
            f".move {which} {numbers.choice(['position', 'velocity'])}={vector}", ".state", f".step {on}", ".state",
            f".back {on + here}", f".step {here}", ".state", f".step {on}", ".state", f".goto {start}", ".state", ".back", ".goto -1",
            f".goto {start + on}", ".state", ".reset", f".step {start + 1}", ".state"], folder)
        check(f"a move of {which} in {start} to where it is", lines[3], lines[1])
        check(f"the state after .back {on + here} and .step {here} from {start + on}", lines[10], lines[5])
        check(f"the state after .step {on} from {start}", lines[12], lines[7])
        check(f"the state after .goto {start}", lines[14], lines[5])
        check(f"the state after .goto {start + on}", lines[18], lines[7])
        check(f"the state after .reset and .step {start + 1}", lines[21], lines[5])
        differ = [a for a, b in zip(lines[3].splitlines(), lines[5].splitlines()) if a != b]
        check("a move changes one entry", len(differ), 1)


def law_of_momentum(folder, numbers):
    """A change of one velocity changes the momentum by mass times this change. Small integers are exact."""
    for _ in range(5):
        velocities = [[numbers.randrange(-9, 9) for _ in range(2)] for _ in range(5)]
        changed = numbers.randrange(5)
        after = [[numbers.randrange(-9, 9) for _ in range(2)] if i == changed else v for i, v in enumerate(velocities)]
        moves = [f".move {i} velocity={x};{y}" for i, (x, y) in enumerate(velocities)]
        lines = printed([".step 9", *moves, ".energy p", f".move {changed} velocity={after[changed][0]};{after[changed][1]}",
                         ".energy p"], folder)
        for line, expected in ((lines[6], velocities), (lines[8], after)):
            total = ";".join(str(sum((i + 1) * v[k] for i, v in enumerate(expected))) for k in range(2))
            check("the momentum", re.search(r"momentum +(\S+)", line).group(1), total)


def law_of_records(folder, numbers):
    """A recorded session and an archive of any sequence of inputs give the same states again."""
    for run in range(6):
        inputs = random_inputs(numbers, 40)
        lines = printed(inputs + [".state", f".record {run}.session"], folder)
        again = subprocess.run([PETRI, "repl", f"{run}.session"], cwd=folder, capture_output=True, text=True, check=False).stdout
        with open(f"{folder}/{run}.session", encoding="utf-8") as session:
            check(f"session {run}", again, session.read())
        check(f"the state of session {run}", lines[-2] in again, True)
        archived = "\n".join(inputs[:9] + [f".archive {run}.petri"] + inputs[9:])
        subprocess.run([PETRI, "repl", "s.fl"], input=archived, cwd=folder, capture_output=True, text=True, check=False)
        verified = subprocess.run([PETRI, "archive", "verify", f"{run}.petri"], cwd=folder, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, check=False)
        check(f"archive {run}: {verified.stdout}", verified.returncode, 0 if "built without SQLite" not in verified.stdout else 2)


with tempfile.TemporaryDirectory() as folder:
    with open(f"{folder}/s.fl", "w", encoding="utf-8") as script:
        script.write(SCRIPT)
    laws_of_conditions(folder, random.Random(1))
    law_of_previous_values(folder, random.Random(2))
    law_of_abbreviations(folder)
    law_of_moves(folder, random.Random(3))
    law_of_momentum(folder, random.Random(4))
    law_of_records(folder, random.Random(5))
print(f"{check.count - check.failed} passed, {check.failed} failed")
sys.exit(check.failed > 0)
