"""Tests of the Python module, after its docstrings."""

import ast
import base64
import copy
import csv
import gc
import math
import importlib.metadata
import importlib.util
import inspect
import os
import pickle
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import traceback
import types
import unittest
import unittest.mock
import warnings
from pathlib import Path

import numpy
import petri

SAMPLES = Path(__file__).parents[2] / "samples"
DISH = """\
let COUNT=COUNT or 3
!physics state=:dish dimensions=2
    !anchor id=:middle position=0;0
    for i in ..COUNT
        !particle id=i position=i+1;2*i velocity=1;0 radius=5 mass=2 charge=i
    !distance from=0 to=1 strength=10 fixed=2
"""
RED = "!window size=4;2\n    !canvas\n        !rect size=4;2 color=1;0;0 fill=true\n"


class Package(unittest.TestCase):
    def test_has_a_description_whose_example_runs(self):
        package = importlib.metadata.distribution("petri").read_text("METADATA")
        fields, text = package.split("\n\n", 1)
        self.assertIn("\nDescription-Content-Type: text/markdown\n", fields)
        self.assertGreater(fields.count("\nClassifier: "), 5)
        self.assertEqual(re.findall("^Project-URL: (\\w+), https://", fields, re.M), ["Homepage", "Documentation", "Changelog", "Source", "Issues"])
        self.assertNotRegex(package, "@[A-Z]+@")
        [example] = re.findall("```python\n(.*?)```", text, re.S)
        ran = subprocess.run([sys.executable, "-W", "error", "-c", example], check=True, stdout=subprocess.PIPE, text=True)
        time, x, y, energy = map(float, ran.stdout.replace("[", "").replace("]", "").split())
        self.assertEqual((time, x), (1.5, 49.5))  # in every wheel, so the example draws nothing
        self.assertAlmostEqual(y, 10 - 9.81 * time ** 2 / 2, delta=0.2)
        self.assertAlmostEqual(energy, 100 * (9.81 * time) ** 2 / 2, delta=300)

    def test_everything_public_is_documented(self):
        for name in petri.__all__:
            thing = getattr(petri, name)
            self.assertTrue(inspect.getdoc(thing), name)
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    self.assertTrue(inspect.getdoc(getattr(thing, member)), f"{name}.{member}")

    def test_help_names_what_exists(self):
        lines = re.findall(r"^([A-Za-z]+)  +\S", petri.__doc__, re.M)
        self.assertGreater(len(lines), 5)
        self.assertTrue(set(lines) <= set(petri.__all__))
        methods = re.search(r"^Session .*: (.*)$", petri.__doc__, re.M).group(1).split(", ")
        self.assertTrue(all(callable(getattr(petri.Session, method)) for method in methods))
        [example] = re.findall("^    import petri\n(?:    .*\n)+", petri.__doc__, re.M)
        names = {}
        exec(inspect.cleandoc("\n" + example), names)  # the first example can be copied
        self.assertEqual(names["session"].frame.number, 59)
        self.assertEqual(names["session"].state["sky", "drop"], tuple(names["session"].systems["sky"].position[0]))


class Views(unittest.TestCase):
    def setUp(self):
        self.session = petri.Session(DISH)
        self.session.step(3)
        self.dish = self.session.systems["dish"]

    def test_match_the_state(self):
        self.assertEqual((len(self.dish), self.dish.dimensions), (4, 2))
        self.assertEqual(self.dish.position.shape, (4, 2))
        self.assertEqual(self.dish.ids, ["middle", 0, 1, 2])
        for row, id in enumerate(self.dish.ids[1:], 1):
            self.assertEqual(tuple(self.dish.position[row]), self.session.state["dish", id])
            self.assertEqual(tuple(self.dish.velocity[row]), self.session.state["dish", id, "velocity"])
            self.assertEqual(self.dish.index(id), row)
        with self.assertRaises(KeyError):
            self.dish.index(99)

    def test_have_all_columns(self):
        self.assertEqual(list(self.dish.radius[1:]), [5, 5, 5])
        self.assertEqual(list(self.dish.mass[1:]), [2, 2, 2])
        self.assertEqual(list(self.dish.charge[1:]), [0, 1, 2])
        self.assertEqual(list(self.dish.anchor), [True, False, False, False])
        self.assertTrue(numpy.isnan(self.dish.force).all())

    def test_forces_need_keep_forces(self):
        session = petri.Session(DISH, options=petri.Options(keep_forces=True))
        session.step(3)
        force = session.systems["dish"].force
        self.assertGreater(abs(force[1]).max(), 0)
        numpy.testing.assert_array_equal(force[1], -force[2])

    def test_explain_the_force_on_a_particle(self):
        script = DISH.replace("dimensions=2", "dimensions=2 resolution=1/120") + "    !drag\n"
        session = petri.Session(script, options=petri.Options(keep_forces=True))
        session.step(3)
        dish = session.systems["dish"]
        found = dish.explain(0)
        self.assertEqual([(part.kind, part.partner, part.line) for part in found.contributions],
                         [("distance", 1, 6), ("drag", None, 7)])
        total = numpy.zeros(2)
        for part in found.contributions:
            total += part.vector
        self.assertEqual(total.tobytes(), found.sum.tobytes())
        self.assertEqual(total.tobytes(), dish.force[dish.index(0)].tobytes())
        first = dish.explain(0, step=0)
        self.assertEqual((dish.steps, found.clock), (2, first.clock + first.delta))
        numpy.testing.assert_allclose(first.velocity + first.sum * first.delta / 2, found.velocity)
        self.assertEqual(dish.explain("middle").contributions, [])
        with self.assertRaises(KeyError):
            dish.explain(99)
        with self.assertRaises(IndexError):
            dish.explain(0, step=2)
        with self.assertRaises(IndexError):
            self.dish.explain(0)

    def test_energies(self):
        script = ("!physics state=:e dimensions=2 resolution=1/240\n"
                  "    !particle id=0 position=0;0 velocity=0;1 mass=2 radius=0\n"
                  "    !particle id=1 position=4;0 velocity=0;-1 mass=3 radius=0\n"
                  "    !gravity strength=5\n    !drag strength=0\n")
        session = petri.Session(script)
        session.step(1)
        system = session.systems["e"]
        self.assertEqual(system.kinetic_energy, (2 + 3) / 2)
        self.assertEqual(system.potential_energies[0], -5 * 2 * 3 / 4)
        self.assertTrue(numpy.isnan(system.potential_energies[1]))
        self.assertEqual((system.potential_energy, system.energy), (-7.5, -5))
        self.assertEqual((system.momentum.tolist(), system.angular_momentum), ([0, -1], -12))
        session.step(60)
        self.assertAlmostEqual(session.systems["e"].kinetic_energy + session.systems["e"].potential_energy, -5, delta=0.01)

    def test_momenta_leave_out_anchors(self):
        session = petri.Session("!physics state=:e dimensions=3\n    !particle id=0 position=1;0;0 velocity=0;2;3 mass=2\n"
                                "    !anchor id=1 position=5;5;5 velocity=1;1;1 mass=9\n"
                                "!physics state=:line dimensions=1\n    !particle id=0 position=1 velocity=2\n")
        session.step()
        system = session.systems["e"]
        self.assertEqual((system.momentum.tolist(), system.angular_momentum.tolist()), ([0, 4, 6], [0, -6, 4]))
        self.assertEqual((session.systems["line"].momentum.tolist(), session.systems["line"].angular_momentum), ([2], None))

    def test_are_read_only_views(self):
        self.assertTrue(numpy.shares_memory(self.dish.position, self.dish.position))
        self.assertFalse(self.dish.position.flags.owndata)
        with self.assertRaises(ValueError):
            self.dish.position[0, 0] = 1
        with self.assertRaises(ValueError):
            self.dish.position.flags.writeable = True

    def test_show_the_last_frame(self):
        before = self.dish.position.copy()
        self.session.step()
        self.assertFalse(numpy.array_equal(before, self.dish.position))

    def test_outlive_the_session(self):
        position = self.dish.position
        copy = position.copy()
        self.session.close()
        del self.session, self.dish
        gc.collect()
        numpy.testing.assert_array_equal(position, copy)

    def test_older_arrays_stay_readable(self):
        session = petri.Session("!physics state=:s dimensions=2 time=time\n"
                                "    for i in ..40000*(1+frame)\n        !particle id=i position=i;frame radius=i\n")
        session.step()
        system, held, copies = session.systems["s"], [], []
        for _ in range(4):
            held += [system.position, system.velocity[::2], system.radius, system.anchor]
            copies += [array.copy() for array in held[-4:]]
            session.step()
        for array, copy in zip(held, copies):
            self.assertEqual(array.shape, copy.shape)
            self.assertTrue(numpy.isfinite(array).all())
        numpy.testing.assert_array_equal(held[2], copies[2])
        before = session._shown.copy()
        del held, array
        gc.collect()
        self.assertLess(len(session._shown), len(before))
        system.position
        self.assertEqual(len(session._shown), 1)
        close = session.close
        del session, system
        close()

    def test_show_added_and_removed_systems(self):
        session = petri.Session("for name in (:a;:b) if frame < 2 else (:b;:c)\n"
                                "    !physics state=name dimensions=1\n        !particle id=name position=frame\n")
        session.step(2)
        b = session.systems["b"]
        self.assertEqual((list(session.systems), b.ids), (["a", "b"], ["b"]))
        a = session.systems["a"]
        session.step()
        self.assertEqual((list(session.systems), b.ids), (["b", "c"], ["b"]))
        with self.assertRaises(LookupError):
            a.position
        with self.assertRaises(KeyError):
            petri.Session(DISH).systems["nothing"]


class State(unittest.TestCase):
    def setUp(self):
        self.session = petri.Session(DISH)
        self.session.step(2)
        self.state = self.session.state

    def test_is_a_mapping(self):
        self.assertIn(("dish", 2), self.state)
        self.assertEqual(self.state["dish", 2], self.state[("dish", 2.0)])
        self.assertEqual(dict(self.state)["dish", 2], self.state["dish", 2])
        self.assertEqual(len(self.state), len(list(self.state)))
        self.assertIsNone(self.state.get(("dish", 17)))
        with self.assertRaises(KeyError):
            self.state["dish", 17]

    def test_each_key_leads_to_its_value(self):
        for name in "!physics state=-0", "!physics state=:s;-0", "!physics state=0":
            session = petri.Session(f"{name} dimensions=1\n    for i in -0;0;0.5;1e300;-3\n        !particle id=i position=i+1\n")
            session.step(2)
            keys = [str(key) for key, _ in session.state.items()]  # each key is found
            self.assertEqual((len(set(keys)), any("-0.0" in key for key in keys)), (len(keys), True), name)

    def test_values_can_be_set(self):
        for value in (3.0, (1.0, 2.0), "word", ("a", "b", 3.0), petri.Text("a text"), (petri.Text(""), 1.0, "s")):
            self.state["mine", petri.Text("key")] = value
            self.assertEqual(self.state["mine", petri.Text("key")], value)
            self.assertEqual(type(self.state["mine", petri.Text("key")]), type(value))
        self.assertNotIn(("mine", "key"), self.state)
        del self.state["mine", petri.Text("key")]
        self.assertNotIn(("mine", petri.Text("key")), self.state)
        with self.assertRaises(KeyError):
            del self.state["mine"]
        with self.assertRaises(ValueError):
            self.state["mine"] = float("nan")

    def test_is_seen_by_the_next_frame(self):
        session = petri.Session("!out value=$:mine\n")
        session.step()
        session.state["mine"] = numpy.arange(3.0)
        session.step()
        self.assertIn("!out value=0;1;2", session.text("tree"))

    def test_only_symbol_numbers_become_str(self):
        self.state["mine"] = "word"
        self.assertEqual(self.session.evaluate("$:mine==:word"), 1)
        self.assertEqual(self.session.evaluate("$:mine=='word'"), 0)


class Running(unittest.TestCase):
    def test_matches_the_command(self):
        file = SAMPLES / "petri.fl"
        run = subprocess.run([os.environ["PETRI"], "run", file, "--frames", "11", "--every", "10", "--print", "hash"],
                             check=True, stdout=subprocess.PIPE, text=True)
        session = petri.Session(file)
        frames = [session.text("hash").strip() for frame in session.frames(11) if frame.number % 10 == 0]
        self.assertEqual("\n".join(frames).split(), run.stdout.split())

    def test_frames_are_numbered(self):
        session = petri.Session("%pragma tempo 30\n!x\n", options=petri.Options(fps=10))
        self.assertEqual(session.frame.number, -1)
        numbers = []
        for frame in session:
            numbers.append(frame.number)
            if frame.number == 4:
                break
        self.assertEqual(numbers, [0, 1, 2, 3, 4])
        self.assertEqual((frame.time, frame.beat, frame.fps, frame.tempo), (0.4, 0.2, 10, 30))

    def test_until_ends_with_the_first_frame_in_which_a_condition_is_true(self):
        session, other = petri.Session(DISH), petri.Session(DISH)
        self.assertTrue(session.until("frame*frame > 50"))
        self.assertEqual(session.frame.number, 8)
        self.assertTrue(session.until("frame*frame > 50"))  # at least one frame
        other.step(10)
        self.assertEqual(session.text("hash"), other.text("hash"))  # conditions change nothing
        self.assertFalse(session.until("frame < 0", 3))
        self.assertFalse(session.until("true", 0))
        self.assertEqual(session.frame.number, 12)
        for condition, value in {"0;0": False, "0;1": True, "null": False, "'x'": True, "''": False}.items():
            self.assertEqual(session.until(condition, 1), value, condition)
        with self.assertRaises(petri.ScriptError):
            session.until("1 +")
        self.assertEqual(session.frame.number, 18)
        with self.assertRaisesRegex(petri.ScriptError, "(?s)unbound name 'fraem'.*did you mean 'frame'") as caught:
            session.until("fraem > 100")  # would never be true
        self.assertEqual((session.frame.number, caught.exception.code), (19, "unbound-name"))
        self.assertTrue(session.until("frame > 19"))

    def test_arguments_of_a_wrong_type_are_rejected(self):
        session = petri.Session("!x y=v\n", given={"v": 1})
        for wrong in ({"a": 1}, {1, 2}, b"ab", 1j, [1, [2, b"c"]], numpy.array([1, 2j])):
            with self.assertRaisesRegex(TypeError, "not a number, a string or a sequence"):
                session.set_global("v", wrong)
        session.step()
        self.assertIn("!x y=1", session.text("tree"))
        with self.assertRaisesRegex(TypeError, r"petri\.Options"):
            petri.Session("!x\n", options={"fps": 3})
        with self.assertRaisesRegex(TypeError, "forces must be a dict"):
            petri.Session("!x\n", forces=lambda step: None)
        with self.assertRaisesRegex(TypeError, "metrics must be a dict"):
            petri.sweep("!x\n", {"A": [1]}, ["A"])
        with self.assertRaisesRegex(TypeError, r"defines\['A'\] must be a list"):
            petri.sweep("!x\n", {"A": 1}, {"a": "A"})
        with self.assertRaisesRegex(TypeError, r"functions\['f'\] must be a function, not 3"):
            petri.Session("!x\n", functions={"f": 3})
        with self.assertRaisesRegex(ValueError, "neighbours must be .*, not 'some'"):
            petri.Session("!x\n", options=petri.Options(neighbours="some"))
        with self.assertRaisesRegex(TypeError, "needs a snapshot of this session, not 3"):
            session.rewind(3)
        with self.assertRaisesRegex(ValueError, "at least 0, not -1"):
            session.step(-1)
        with self.assertRaisesRegex(TypeError, "at least one expression"):
            session.trust()
        with self.assertRaisesRegex(FileNotFoundError, "No such file.*gone.state"):
            session.restore("gone.state")

    def test_archives_that_cannot_be_opened_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "other.petri"
            other.write_text("not an archive")
            with self.assertRaisesRegex(petri.ArchiveError, f"cannot read '{other}': "):
                petri.Archive(other)
            with self.assertRaisesRegex(FileNotFoundError, "gone.petri"):
                petri.Archive(Path(folder) / "gone.petri")
            with self.assertRaisesRegex(petri.ArchiveError, f"cannot write '{folder}/no/a.petri': "):
                petri.Session("!x\n").archive(Path(folder) / "no/a.petri")

    def test_names_that_are_missing_are_reported_with_those_that_exist(self):
        session = petri.Session("let A=A or 1\n!physics state=:s dimensions=1\n    !particle id=1\n")
        with self.assertRaisesRegex(petri.ScriptError, "cannot set 'B': the script has the parameters A"):
            session.set_parameter("B", 2)
        with self.assertRaisesRegex(petri.ScriptError, "'a word' is not a number"):
            session.set_parameter("A", "a word")
        with self.assertRaisesRegex(KeyError, "no system 's' in the last frame; it has none"):
            session.systems["s"]
        session.step(2)
        with self.assertRaisesRegex(KeyError, "no system 't' in the last frame; it has 's'"):
            session.systems["t"]
        there = session.snapshot()
        session.rewind(there)
        self.assertEqual(len(session.systems), 0)
        self.assertIn(("s", 1), session.state)
        session.step()
        self.assertEqual(list(session.systems), ["s"])

    def test_integrate_reaches_a_time(self):
        for fps in (1, 10, 60, 144, 1000):
            session = petri.Session("!x\n", options=petri.Options(fps=fps))
            for time in (0, 0.3, 0.3, 1, 0.5, 2.05):
                before = session.frame
                frame = session.integrate(time)
                self.assertGreaterEqual(frame.time, time)
                self.assertTrue(frame == before or frame.number == 0 or frame.time - 1 / fps < time, (fps, time, frame))
        for time in (float("inf"), float("nan")):
            with self.assertRaises(ValueError):
                session.integrate(time)

    def test_definitions_and_parameters_change_values(self):
        session = petri.Session(DISH, COUNT=5)
        session.step()
        self.assertEqual(len(session.systems["dish"]), 6)
        session.set_parameter("COUNT", 2)
        session.step()
        self.assertEqual(len(session.systems["dish"]), 3)
        session.set_parameter("COUNT", None)
        session.step()
        self.assertEqual(len(session.systems["dish"]), 4)
        with self.assertRaises(petri.ScriptError):
            session.set_parameter("NOTHING", 2)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            given = petri.Session("let V=V or 0 W=W or 'x'\n!x v=V w=W\n", V=(1, 2), W=petri.Text("it's"))
        given.step()
        self.assertIn('!x v=1;2 w="it\'s"', given.text("tree"))

    def test_globals_can_be_changed(self):
        session = petri.Session("!x v=2*wind\n", given={"wind": (1, 2)})
        session.step()
        self.assertIn("!x v=2;4", session.text("tree"))
        session.set_global("wind", numpy.float64(5))
        session.step()
        self.assertIn("!x v=10", session.text("tree"))
        with self.assertRaises(KeyError):
            session.set_global("rain", 1)
        with self.assertRaises(petri.ScriptError):
            petri.Session("!x\n", given={"time": 1})

    # Arrays are passed as buffers. Each must be the same value as its elements in a list.
    def test_globals_can_be_arrays(self):
        session = petri.Session("!x v=wind n=len(wind)\n", given={"wind": 0})
        whole, grid = numpy.arange(-3, 9), numpy.arange(24.0).reshape(4, 3, 2) / 8
        readonly = numpy.linspace(0, 1, 5)
        readonly.flags.writeable = False
        arrays = [whole, grid, grid.T, grid[::-2, 1], whole[::3], readonly, whole.astype(">i4"), grid.astype("<f4"),
                  grid.astype(">f8"), grid.astype(numpy.longdouble), whole.astype(numpy.uint8), whole > 2,
                  numpy.array([numpy.nan, numpy.inf, -0.0, 5e-324, 2.0**60]), numpy.array([], float), numpy.zeros((3, 0)),
                  numpy.array([2**63 - 1, 2**53 + 1]), numpy.asfortranarray(grid[0])]
        for array in arrays:
            texts = []
            for value in (array, array.tolist()):
                session.set_global("wind", value)
                session.step()
                texts.append(session.text("tree").split("\n", 1)[1])
            self.assertEqual(*texts, array)
        session.set_global("wind", numpy.array(2.5))  # of no dimensions
        session.step()
        self.assertIn("!x v=2.5 n=1", session.text("tree"))
        passed = numpy.array([1.0, 2.0])
        session.set_global("wind", passed)
        passed[0] = 7  # the session has its own copy
        session.step()
        self.assertIn("!x v=1;2 n=2", session.text("tree"))

    def test_ids_are_those_of_the_script(self):
        for listed, wanted in {"..4": [0, 1, 2, 3], "-2;0.5;1e300;7": [-2, 0.5, int(1e300), 7], ":b;:a;3": ["b", "a", 3],
                               "'a';1": [petri.Text("a"), 1], "9007199254740993;3": [9007199254740992, 3], "-0;0;3": [-0.0, 0, 3]}.items():
            session = petri.Session(f"!physics state=:s dimensions=1\n    for i in {listed}\n        !particle id=i position=i\n")
            session.step()
            ids = session.systems["s"].ids
            self.assertEqual([(type(id), id) for id in ids], [(type(id), id) for id in wanted], listed)
            self.assertEqual([session.systems["s"].index(id) for id in ids], list(range(len(ids))), listed)
        session = petri.Session("!physics state=:s dimensions=1\n    for i in ..(5-frame)\n        !particle id=i;i+1 position=i\n")
        for frame in range(6):
            session.step()
            self.assertEqual(session.systems["s"].ids, [(i, i + 1) for i in range(5 - frame)])

    def test_evaluate_returns_values(self):
        session = petri.Session("let a=1;2;3\n")
        session.step()
        for text, value in {"a": (1, 2, 3), "sum(a)": 6, "null": None, ":word": "word", "'te;xt'": petri.Text("te;xt"),
                            '"it\'s"': petri.Text("it's"),
                            r"'\'\"\n\\'": petri.Text("'\"\n\\"), ":odd;'a;b'": ("odd", petri.Text("a;b")),
                            "1;:b;'c'": (1, "b", petri.Text("c")), "-1e300;inf": (-1e300, float("inf"))}.items():
            self.assertEqual(session.evaluate(text), value)
            self.assertEqual(type(session.evaluate(text)), type(value) if value != 6 else float)
        with self.assertRaises(petri.ScriptError):
            session.evaluate("1 +")

    def test_trust_contains_the_true_value(self):
        """A spring from rest: the exact motion is a cosine."""
        session = petri.Session("!physics state=:s dimensions=1\n    !anchor id=:wall\n    !particle id=:ball position=2.5\n"
                                "    !distance from=:wall to=:ball fixed=2\n")
        session.step(50)
        before = session.text("digest")
        for found in session.trust("$(:s;:ball)", "$(:s;:ball;:velocity)", frames=181, every=60)[2:]:
            exact = (2 + 0.5 * math.cos(found.time)) if found.expression == "$(:s;:ball)" else -0.5 * math.sin(found.time)
            self.assertLess(abs(found.value - exact), found.error)
            self.assertLess(found.error, 2 * abs(found.value - exact) + 1e-3)
            self.assertAlmostEqual(found.order, 1 if found.expression == "$(:s;:ball)" else 2, delta=0.2)
            self.assertTrue(math.isnan(found.lyapunov_time))
        self.assertEqual(session.text("digest"), before)
        self.assertEqual([found.frame for found in session.trust("frame;1")], [49])
        self.assertEqual(session.trust("'word'")[0].verdict, "not a number")
        with self.assertRaises(petri.ScriptError):
            session.trust("1 +")
        self.assertEqual(session.text("digest"), before)

    def test_rewind_repeats_frames(self):
        session = petri.Session(DISH)
        session.step(5)
        snapshot = session.snapshot()
        session.step(5)
        there = session.text("hash")
        session.rewind(snapshot)
        self.assertEqual((session.frame.number, snapshot.frame), (4, 4))
        session.step(5)
        self.assertEqual(session.text("hash"), there)
        with self.assertRaises(ValueError):
            petri.Session(DISH).rewind(snapshot)
        del session
        gc.collect()
        self.assertGreater(snapshot.nbytes, 0)

    def test_restore_resumes_saved_state(self):
        session, other = petri.Session(DISH), petri.Session(DISH)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "dish.state"
            with self.assertRaises(FileNotFoundError):
                other.restore(file)
            session.step(5)
            session.save(file)
            other.restore(file)
        session.step()
        other.step()
        self.assertEqual(session.text("state"), other.text("state"))

    def test_closed_session_is_unusable(self):
        with petri.Session(DISH) as session:
            session.step()
            session.snapshot()
        for use in (session.step, session.snapshot, lambda: session.evaluate("1"), lambda: session.state["a"],
                    lambda: session.systems["dish"], lambda: session.picture(), lambda: next(iter(session))):
            self.assertRaises((petri.ScriptError, LookupError, MemoryError, ValueError), use)


class Functions(unittest.TestCase):
    def test_scripts_call_functions(self):
        def push(x, angle=2, *more):
            """A push."""
            seen.append((x, angle, more))
            return (x + 1, 2 * angle) if x is not None else petri.Text("none")

        seen = []
        session = petri.Session("!a b=push(frame) c=push(null;null, 5, :s, 't', 3;4)\n", functions={"push": push})
        session.step(2)
        self.assertEqual(seen[-2:], [(1.0, 2.0, ()), (None, 5.0, ("s", petri.Text("t"), (3.0, 4.0)))])
        self.assertIs(type(seen[-1][2][0]), str)
        self.assertEqual(session.text("tree").split("\n")[1], "!a b=2;4 c='none'")

    def test_exceptions_reach_the_caller(self):
        def fail(x):
            if x == 2:
                raise KeyError("two")
            return x

        session = petri.Session("!counter state=:n rate=60\n!a b=fail($:n)\n", functions={"fail": fail})
        with self.assertRaisesRegex(KeyError, "two"):
            session.step(10)
        self.assertEqual(session.frame.number, 3)
        self.assertEqual(session.text("tree").split("\n")[2], "!a")
        session.step()
        self.assertEqual(session.text("tree").split("\n")[2], "!a b=3")
        for wrong, error in ((lambda x: ":symbol", TypeError), (lambda x: object(), TypeError)):
            with self.assertRaises(error):
                petri.Session("!a b=f(frame)\n", functions={"f": wrong}).step()
        with self.assertRaises(petri.ScriptError):
            petri.Session("!a\n", functions={"sin": fail})
        with self.assertRaisesRegex(TypeError, "by position"):
            petri.Session("!a\n", functions={"f": lambda *, x: x})

    def test_cannot_use_their_session(self):
        def use(x):
            session.evaluate("1") if x else session.step()

        session = petri.Session("!a b=use(frame)\n", functions={"use": use})
        for _ in range(2):
            with self.assertRaisesRegex(RuntimeError, "cannot use the session"):
                session.step()

    def test_cannot_close_their_session(self):
        session = petri.Session("!a b=use(frame)\n", functions={"use": lambda x: session.close()})
        with self.assertRaisesRegex(RuntimeError, "cannot use the session"):
            session.step()
        self.assertEqual(repr(session)[:20], "<petri.Session after")

    def test_ctrl_c_before_the_function_is_raised(self):
        def interrupt(frame, event, _):
            if frame.f_code.co_name == "petri_python_called":
                raise KeyboardInterrupt

        session = petri.Session("!a b=f(frame)\n", functions={"f": lambda x: x})
        sys.settrace(interrupt)
        try:
            with self.assertRaises(KeyboardInterrupt):
                session.step(10)
        finally:
            sys.settrace(None)
        session.step()

    def test_can_use_another_session(self):
        inner = petri.Session("!counter state=:n rate=60\n")

        def inside(x):
            inner.step(2)
            return inner.state["n"]

        outer = petri.Session("!a b=inside(frame)\n", functions={"inside": inside})
        outer.step(3)
        self.assertEqual(outer.text("tree").split("\n")[1], "!a b=5")
        killer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
        killer.start()
        with self.assertRaises(KeyboardInterrupt):
            outer.step(10**12)
        killer.join()
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)


class Closed(unittest.TestCase):
    def test_closed_sessions_have_no_frame_and_no_systems(self):
        session = petri.Session("!physics state=:s\n    !particle id=1\n")
        session.step()
        systems, state = session.systems, session.state
        session.close()
        self.assertEqual(repr(state), "<petri.State, closed>")
        for use in (lambda: state["s", 1], lambda: list(state), lambda: ("s", 1) in state, lambda: state.update(a=1),
                    lambda: session.frame, lambda: list(systems), lambda: session.systems["s"], lambda: len(session.parameters)):
            self.assertRaises(ValueError, use)

    def test_missing_scripts_are_missing_files(self):
        for missing in ("gone.fl", Path("gone.fl"), "!x y=1"):
            with self.assertRaisesRegex(FileNotFoundError, "must contain a newline") as caught:
                petri.Session(missing)
            self.assertEqual(caught.exception.filename, os.fspath(missing))
        with self.assertRaises(FileNotFoundError):
            petri.sweep("gone.fl", {"A": [1, 2]}, {"x": "A"})


class Sweeps(unittest.TestCase):
    def test_match_petri_sweep(self):
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder) / "dish.fl"
            script.write_text("let SEED=SEED or 1\n" + DISH.replace("velocity=1;0", "velocity=SEED;0"))
            run = subprocess.run([os.environ["PETRI"], "sweep", script, "-D", "COUNT=3;5", "--seeds", "2", "--frames", "4",
                                  "--metric", "x=$(:dish;1)[0]", "--metric", "n=COUNT*SEED"], check=True,
                                 stdout=subprocess.PIPE, text=True)
            table = petri.sweep(script, {"COUNT": [3, 5]}, {"x": "$(:dish;1)[0]", "n": "COUNT*SEED"}, seeds=2, frames=4)
        lines = [line.split(",") for line in run.stdout.splitlines()]
        self.assertEqual(list(table), lines[0][1:])
        for row, line in enumerate(lines[1:]):
            self.assertEqual([float(table[name][row]) for name in list(table)[:-1]], [float(cell) for cell in line[1:-1]])
        self.assertEqual(table["error"], [None] * 4)

    def test_failed_run_is_a_row(self):
        table = petri.sweep("let N=N or 1\n    LONG=sum(i*i for i in ..N*10000)+frame\n", {"N": [1, 1000, 2]},
                            {"twice": "2*N"}, frames=9, until="frame == 3", options=petri.Options(work_limit=5 << 20), jobs=2)
        self.assertEqual(table["twice"], [2, None, 4])
        self.assertEqual([table["frame"][0], table["frame"][2]], [3, 3])
        self.assertIn("exceeded its limit", table["error"][1])
        with self.assertRaises(ValueError):
            petri.sweep("!a\n", {"N": [1]}, {"N": "1"})

    def test_mistakes_are_errors_before_the_first_run(self):
        calls = []
        script = "let A=A or 1 B=B if B != null else 2\nlet C=spy(A)\n"
        ways = {"A": lambda values: values, "text": lambda values: ";".join(map(str, values))}  # this process; the command
        for kind, written in ways.items():
            functions = {"spy": lambda x: calls.append(x) or x} if kind == "A" else None
            text = script if functions else script.replace("spy(A)", "A")

            def sweep(defines, metrics, **more):
                return petri.sweep(text, {name: written(values) for name, values in defines.items()}, metrics, frames=3,
                                   functions=functions, **more)

            for defines, metrics, more, message in (
                    ({"A": [1, 2]}, {"x": "AA+1"}, {}, "did you mean 'A'"), ({"A": [1, 2]}, {"x": "A"}, {"until": "frme > 1"}, "'frme'"),
                    ({"AA": [1, 2]}, {"x": "A"}, {}, "did you mean 'A'"), ({"A": [1, 2]}, {"x": "A"}, {"seeds": 2}, "does not read 'SEED'"),
                    ({"A": [2, 1, 0]}, {"x": "A"}, {}, "write 'let A=A if A != null else 1'"),
                    ({"A": [2, "x"]}, {"x": "A"}, {}, "does not accept A=.?x")):
                calls.clear()
                with self.subTest(kind=kind, message=message):
                    with self.assertRaisesRegex(petri.PetriError, f"(?s){message}.*cannot|cannot .*{message}"):
                        sweep(defines, metrics, **more)
                self.assertLess(len(calls), 9)  # no run has started
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                table = sweep({"B": [0, 2], "LIMIT": [0, 1]}, {"x": "B"}, until="frame >= LIMIT")
            self.assertEqual((table["x"], table["frame"]), ([0, 0, 2, 2], [0, 1, 0, 1]))

    def test_unstable_runs_are_marked_and_counted(self):
        script = ("let K=K or 100\n!physics state=:s dimensions=1\n    !anchor id=:wall\n    !particle id=:weight position=10\n"
                  "    !distance from=:wall to=:weight fixed=8 strength=K\n")
        tables = []
        for values in ([100, 15000, 30000, 15000], "100;15000;30000;15000"):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                tables.append(petri.sweep(script, {"K": values}, {"x": "$(:s;:weight)[0]"}, frames=60, jobs=1))
            self.assertEqual(sum("3 of 4 runs failed or are unstable" in str(warning.message) for warning in caught), 1)
        self.assertEqual([table.pop("error")[0] for table in tables], [None, None])
        self.assertEqual(*tables)
        self.assertEqual([x is None for x in tables[0]["x"]], [False, False, True, False])


class CommandSweeps(unittest.TestCase):
    """Sweeps with options of `petri sweep` that the command executes."""

    SCRIPT = "let A=A or 1\nlet B=B or 1\nlet SEED=SEED or 1\n!physics state=:d dimensions=2\n    !particle id=1 velocity=A;SEED\n"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.script = self.folder / "a.fl"
        self.script.write_text(self.SCRIPT)

    def command(self, *words):
        run = subprocess.run([os.environ["PETRI"], "sweep", "--quiet", self.script, "--frames=3", "--metric=x=A*SEED", *words],
                             check=True, stdout=subprocess.PIPE, text=True)
        return list(csv.DictReader(run.stdout.splitlines()))

    def assert_same(self, table, rows):
        self.assertEqual(table["x"], [float(row["x"]) for row in rows])
        self.assertEqual(table["A"], [float(row["A"]) for row in rows])

    def test_sample_is_that_of_the_command(self):
        for sample, words in ((5, "latin:5"), ("latin:5:9", "latin:5:9")):
            table = petri.sweep(self.script, {"A": "0..1", "B": [1, 2, 3]}, {"x": "A*SEED"}, frames=3, seeds=2, sample=sample)
            self.assertEqual((len(table["x"]), len(set(table["A"]))), (10, 5))
            self.assertLessEqual(set(table["B"]), {1, 2, 3})
            self.assert_same(table, self.command("-D", "A=0..1", "-D", "B=1;2;3", "--seeds=2", "--sample", words))

    def test_values_keep_their_types(self):
        table = petri.sweep(self.SCRIPT, {"A": "1..3", "B": [(1, 2), 0.5]}, {"b": "B", "t": "'a, b'", "n": "null"}, frames=2,
                            where="A > 1", every=1, until="frame==0")
        self.assertEqual(table, {"A": [2, 2, 3, 3], "B": [(1, 2), 0.5] * 2, "frame": [0] * 4, "b": [(1.0, 2.0), 0.5] * 2,
                                 "t": ["a, b"] * 4, "n": [None] * 4, "error": [None] * 4})

    def test_quantities_are_metrics(self):
        table = petri.sweep(self.script, {"A": [3]}, {"kinetic_energy": None, "momentum": None}, frames=2)
        self.assertEqual((table["kinetic_energy"], table["momentum"]), ([5.0], [(3.0, 1.0)]))

    def test_trust_adds_columns(self):
        table = petri.sweep(self.script, {"A": [1, 2]}, {"x": "$(:d;1)"}, frames=3, trust=True)
        self.assertEqual([digits >= 12 for digits in table["x_digits"]], [True, True])

    def test_output_and_summary_are_those_of_the_command(self):
        mine, theirs = self.folder / "mine.csv", self.folder / "theirs.csv"
        table = petri.sweep(self.script, {"A": [1, 2]}, {"x": "A*SEED"}, frames=3, seeds=3, output=mine,
                            summary=self.folder / "summary.csv")
        self.command("-D", "A=1;2", "--seeds=3", "-o", theirs)
        self.assertEqual(mine.read_bytes(), theirs.read_bytes())
        self.assertEqual((table["x"], table["SEED"]), ([1, 2, 3, 2, 4, 6], [1, 2, 3] * 2))
        with open(self.folder / "summary.csv", newline="") as file:
            self.assertEqual([(row["A"], row["mean"], row["std"]) for row in csv.DictReader(file)],
                             [("1", "2", "1"), ("2", "4", "2")])

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not installed")
    def test_output_can_be_hdf5(self):
        arguments = {"defines": {"A": [1, 2], "B": [(1, 2)]}, "metrics": {"x": "A/3", "b": "B", "n": "null"}, "frames": 3}
        try:
            table = petri.sweep(self.script, **arguments, output=self.folder / "a.h5")
        except petri.PetriError as error:
            self.skipTest(str(error))
        self.assertEqual(table, petri.sweep(self.script, **arguments))

    def test_interrupted_sweep_resumes(self):
        script = "let A=A or 1\nlet X=sum(i*frame for i in ..100000)\n"
        output = self.folder / "a.csv"
        program = ("import glob, os, petri, signal, sys, threading, time\n"
                   "def stop():\n"
                   "    while not any(open(name, 'rb').read().count(b'\\nrun ') > 1 for name in glob.glob(sys.argv[2] + '.part*')):\n"
                   "        time.sleep(0.01)\n"
                   "    os.kill(os.getpid(), signal.SIGINT)\n"
                   "if sys.argv[3] == 'stop':\n    threading.Thread(target=stop, daemon=True).start()\n"
                   "try:\n    print(petri.sweep(sys.argv[1], {'A': range(1, 21)}, {'x': 'A'}, jobs=1, output=sys.argv[2], frames=30))\n"
                   "except KeyboardInterrupt:\n    print('aborted')\n")

        def run(what):
            return subprocess.run([sys.executable, "-c", program, script, output, what], check=True, timeout=100,
                                  stdout=subprocess.PIPE, text=True).stdout

        self.assertEqual(run("stop"), "aborted\n")
        self.assertFalse(output.exists())
        self.assertTrue(list(self.folder.glob("a.csv.part*")))
        resumed = ast.literal_eval(run("resume"))
        self.assertFalse(list(self.folder.glob("a.csv.part*")))
        self.assertEqual(resumed["x"], list(range(1, 21)))

    def test_plan_is_read(self):
        plan = self.folder / "plan.yaml"
        plan.write_text(f"script: {self.script}\nframes: 3\ndefine:\n  A: [1, 2]\nmetric:\n  x: A\noutput: never.csv\n")
        try:
            table = petri.sweep(plan=plan)
        except petri.PetriError as error:
            self.skipTest(str(error))
        self.assertEqual(table, {"A": [1, 2], "frame": [2, 2], "x": [1, 2], "error": [None] * 2})
        self.assertEqual(petri.sweep(plan=plan, frames=9)["frame"], [8, 8])

    def test_plot_is_drawn(self):
        plot = self.folder / "plot.svg"
        try:
            petri.sweep(self.script, {"A": [1, 2, 3]}, {"x": "A"}, frames=2, plot=plot)
        except petri.PetriError as error:
            self.skipTest(str(error))
        self.assertIn("<svg", plot.read_text())

    def test_cache_keeps_results(self):
        cache = self.folder / "cache"
        cache.mkdir()
        arguments = {"defines": {"A": [1, 2]}, "metrics": {"x": "A"}, "frames": 3, "cache": cache}
        first = petri.sweep(self.script, **arguments)
        self.assertTrue(any(path.is_file() for path in cache.rglob("*")))
        self.assertEqual(petri.sweep(self.script, **arguments, verify_cache=100), first)

    def test_last_shard_has_the_table(self):
        def shard(number):
            return petri.sweep(self.script, {"A": [1, 2, 3]}, {"x": "A"}, frames=2, output=self.folder / "a.csv", shard=f"{number}/2")

        self.assertEqual(shard(1), {})
        self.assertEqual(shard(2)["x"], [1, 2, 3])

    def test_options_reach_the_command(self):
        slow = "let A=A or 1\nlet X=sum(i for i in ..A*100000)\n"
        options = petri.Options(work_limit=1 << 20, fps=10, neighbours="never", simplify=False, no_files=True, threads=2,
                                memory_limit=100 << 20, read_folders=[self.folder])
        with self.assertWarnsRegex(petri.PetriWarning, "exceeded its limit"):
            table = petri.sweep(slow, {"A": "1;1000"}, {"t": "time"}, frames=11, options=options, jobs=1)
        self.assertEqual(table["t"], [1.0, None])
        self.assertIn("exceeded its limit", table["error"][1])

    def test_errors_and_warnings_are_raised(self):
        with self.assertRaisesRegex(petri.PetriError, "expects latin:COUNT"):
            petri.sweep(self.script, {"A": [1]}, {"x": "A"}, sample="square:3")
        with self.assertRaisesRegex(ValueError, "given, functions"):
            petri.sweep(self.script, {"A": [1]}, {"x": "A"}, sample=3, functions={"twice": twice})
        with self.assertRaisesRegex(petri.PetriError, "unbound name 'foo'"):
            petri.sweep(self.script, {"A": "1"}, {"x": "foo"}, frames=2)
        with unittest.mock.patch.dict(os.environ, PATH=""), self.assertRaises(petri.MissingLibraryError):
            petri.sweep(self.script, {"A": "1"}, {"x": "A"}, frames=2)
        with self.assertRaises(ValueError):
            petri.Session("\n", options=petri.Options(neighbours="some"))


class Threads(unittest.TestCase):
    def test_interrupt_from_another_thread(self):
        session = petri.Session(DISH)
        ended = []

        def run():
            try:
                session.step(10**12)
            except petri.InterruptedStep as error:
                ended.append(error)

        thread = threading.Thread(target=run)
        thread.start()  # the GIL must be released, or the next line would never run
        while session._lock.acquire(blocking=False):
            session._lock.release()
        session.interrupt()
        thread.join()
        self.assertEqual(len(ended), 1)
        session.step(3)
        self.assertIn(("dish", 0), session.state)

    def test_ctrl_c_aborts_the_frame(self):
        session = petri.Session(DISH)
        killer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
        killer.start()
        with self.assertRaises(KeyboardInterrupt):
            session.step(10**12)
        killer.join()
        number = session.frame.number
        session.step()
        self.assertEqual(session.frame.number, number + 1)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_ctrl_c_aborts_all_that_computes_frames(self):
        session = petri.Session("!physics state=:s dimensions=1\n    !particle id=0 position=1\n")
        session.step(3)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "long.petri"
            recorded = petri.Session("!x\n")
            try:
                with recorded.archive(file):
                    recorded.step(10)
            except petri.ArchiveError as error:
                self.skipTest(str(error))
            archive = petri.Archive(file)
            for call in (lambda: session.trust("$(:s;0)", frames=10**9), lambda: archive.session(10**9)):
                killer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
                killer.start()
                with self.assertRaises(KeyboardInterrupt):
                    call()
                killer.join()
                self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
            self.assertEqual(archive.session(5).frame.number, 5)
        session.step()
        self.assertEqual(session.frame.number, 3)

    def test_threads_share_a_session(self):
        session = petri.Session(DISH)
        threads = [threading.Thread(target=lambda: [session.step(10) for _ in range(20)]) for _ in range(4)]
        for thread in threads:
            thread.start()
        for _ in range(100):
            len(session.state), session.frame, session.systems.get("dish")
        for thread in threads:
            thread.join()
        self.assertEqual(session.frame.number, 799)


class Diagnostics(unittest.TestCase):
    def test_errors_are_raised(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "wrong.fl"
            file.write_text("!x\n    y=(1\n")
            with self.assertRaises(petri.ScriptError) as caught:
                petri.Session(file)
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column, error.code), (str(file), 2, 6, "syntax"))
        self.assertIn("y=(1\n", str(error))
        self.assertEqual(error.diagnostics[0].level, "error")

    def test_limits_are_raised(self):
        session = petri.Session("for i in ..1000000\n    !x y=i+frame\n", options=petri.Options(work_limit=10000))
        with self.assertRaises(petri.LimitError) as caught:
            session.step()
        self.assertEqual((caught.exception.code, caught.exception.line), ("work-limit", 2))

    def test_warnings_are_issued(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            petri.Session("!physics state=:a dimensions=2 strange=3\n    !particle id=1 position=1;2\n").step()
        self.assertEqual([(w.category, w.lineno, w.message.column, w.message.code) for w in caught],
                         [(petri.PetriWarning, 1, 32, "unknown-attribute")])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(petri.PetriWarning):
                petri.Session("let x=1\n", NOTHING=1)

    def test_wrong_arguments_are_errors(self):
        with self.assertRaises(ValueError):
            petri.Session(DISH, options=petri.Options(fps=-1))
        with self.assertRaisesRegex(ValueError, "read_folders contains a NUL"):
            petri.Session(DISH, options=petri.Options(read_folders=["data\0x"]))
        with self.assertRaises(ValueError):
            petri.Session(DISH).state["no name"]
        with self.assertRaises((TypeError, ValueError)):
            petri.Session(DISH).state[object()]


class OtherPackages(unittest.TestCase):
    def test_pictures_can_be_saved(self):
        session = petri.Session(RED)
        session.step()
        try:
            pixels = session.picture().pixels
        except petri.MissingLibraryError:
            self.skipTest("this build does not draw")
        self.assertEqual((pixels.shape, pixels.dtype), ((2, 4, 4), numpy.uint8))
        self.assertTrue((pixels == [255, 0, 0, 255]).all())
        picture = session.picture(8, 4)
        self.assertEqual((picture.width, picture.height, picture.frame), (8, 4, 0))
        session.close()
        self.assertEqual(picture._repr_png_()[:8], b"\x89PNG\r\n\x1a\n")
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(petri.ScriptError):
                picture.save(Path(folder) / "picture.bmp")
            picture.save(Path(folder) / "picture.svg")
            self.assertIn("<svg", (Path(folder) / "picture.svg").read_text())
        empty = petri.Session("let x=1\n")
        empty.step()
        self.assertRaises(petri.ScriptError, empty.picture)

    def test_to_dataframe_has_all_columns(self):
        session = petri.Session(DISH)
        session.step()
        dish = session.systems["dish"]
        with unittest.mock.patch.dict(sys.modules, pandas=types.SimpleNamespace(DataFrame=dict)):
            table = dish.to_dataframe()
        self.assertEqual(list(table), ["id", "anchor", "x1", "x2", "v1", "v2", "radius", "mass", "charge"])
        numpy.testing.assert_array_equal(table["x2"], dish.position[:, 1])
        self.assertTrue(table["x2"].flags.owndata)

    def test_to_ase_has_all_particles(self):
        try:
            import ase.io
        except ImportError:
            self.skipTest("there is no ase (Debian: python3-ase)")
        session = petri.Session(DISH)
        session.step(3)
        dish = session.systems["dish"]
        atoms = dish.to_ase()
        self.assertEqual((len(atoms), str(atoms.symbols)), (4, "X4"))
        numpy.testing.assert_array_equal(atoms.positions[:, :2], dish.position)
        numpy.testing.assert_array_equal(atoms.positions[:, 2], 0)
        numpy.testing.assert_allclose(atoms.get_velocities()[:, :2], dish.velocity, rtol=1e-15)
        numpy.testing.assert_array_equal(atoms.get_masses(), dish.mass)
        numpy.testing.assert_array_equal(atoms.get_initial_charges(), dish.charge)
        numpy.testing.assert_array_equal(atoms.arrays["radius"], dish.radius)
        self.assertGreater(atoms.get_kinetic_energy(), 0)
        session.step()
        self.assertFalse(numpy.array_equal(atoms.positions[:, :2], dish.position))
        with tempfile.TemporaryDirectory() as folder:  # ASE can also read the output of petri run
            script = Path(folder) / "dish.fl"
            script.write_text(DISH)
            file = Path(folder) / "run.xyz"
            subprocess.run([os.environ["PETRI"], "run", script, "--frames", "4", "--trajectory", file], check=True)
            frames = ase.io.read(file, index=":")
        self.assertEqual(len(frames), 4)
        numpy.testing.assert_array_equal(frames[3].positions[:, :2], dish.position)

    def test_missing_packages_are_named(self):
        dish = petri.Session(DISH)
        dish.step()
        with unittest.mock.patch.dict(sys.modules, pandas=None, ase=None):
            with self.assertRaisesRegex(ImportError, r"to_dataframe\(\) needs pandas.*python3-pandas"):
                dish.systems["dish"].to_dataframe()
            with self.assertRaisesRegex(ImportError, r"to_ase\(\) needs ase.*python3-ase"):
                dish.systems["dish"].to_ase()


class Archives(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name) / "run.petri"
        self.addCleanup(self.folder.cleanup)

    def record(self, frames=30):
        session = petri.Session(DISH, given={"pushed": 0})
        try:
            recording = session.archive(self.path, keyframe_every=10)
        except petri.ArchiveError as error:
            self.skipTest(str(error))  # built without SQLite
        with recording:
            positions = []
            for i in range(frames):
                if i == 12:
                    session.set_global("pushed", (1.5, 2))
                if i == 20:
                    session.state["mark", 1] = i
                session.step()
                positions.append(numpy.array(session.systems["dish"].position))
            recording.note("recorded by a test")
        return positions

    def test_replay_has_the_recorded_frames(self):
        positions = self.record()
        archive = petri.Archive(self.path)
        self.assertEqual(archive.info["last_frame"], 29)
        self.assertEqual(archive.info["script"], "<string>")
        self.assertEqual([keyframe.frame for keyframe in archive.keyframes], [-1, 9, 19, 29])
        self.assertEqual([file.name for file in archive.files], ["<string>"])
        self.assertEqual(len(archive.info["sha256"]), 64)
        for frame in (25, 3, 29):
            session = archive.session(frame)
            self.assertEqual(session.frame.number, frame)
            numpy.testing.assert_array_equal(session.systems["dish"].position, positions[frame])
        self.assertEqual(session.state["mark", 1], 20)
        session.step(3)  # continues after the recorded frames
        self.assertEqual(session.frame.number, 32)
        self.assertEqual(list(petri.Archive(self.path).verify()), list(range(30)))
        self.assertIsNone(archive.digest(100))

    def test_sessions_keep_their_archive(self):
        positions = self.record(12)
        session = petri.Archive(self.path).session(5)
        gc.collect()
        session.step()
        numpy.testing.assert_array_equal(session.systems["dish"].position, positions[6])

    def test_damage_is_an_error(self):
        self.record(12)
        whole = self.path.read_bytes()
        self.path.write_bytes(whole[:len(whole) // 2])
        with self.assertRaises(petri.ArchiveError):
            petri.Archive(self.path).check()
        with self.assertRaisesRegex(petri.ArchiveError, "not an archive"):
            petri.Archive(__file__)

    def test_session_is_recorded_again(self):
        self.record(1)
        folder = Path(self.folder.name)
        for reloads in range(3):
            (folder / "script.fl").write_text("!counter state=:a rate=1\n")
            session = petri.Session(folder / "script.fl")
            for _ in range(reloads):
                session.reload()
            with session.archive(folder / "1.petri"):
                session.step(5)
            second = session.archive(folder / "2.petri")
            session.step(4)
            with session.archive(folder / "3.petri"):  # completes the second
                session.step(3)
            second.close()
            for name, frames in ("1.petri", range(0, 5)), ("2.petri", range(5, 9)), ("3.petri", range(9, 12)):
                self.assertEqual(list(petri.Archive(folder / name).verify()), list(frames))

    def test_names_are_those_of_files(self):
        self.record(1)
        session = petri.Session(DISH, given={"pushed": 0})
        for name in "\0", f"{self.path}\0x":
            with self.assertRaisesRegex(ValueError, "null character"):
                session.archive(name)
            with self.assertRaisesRegex(ValueError, "null character"):
                petri.Archive(name)
        for name in "", ":memory:", "-", "x/":
            with self.assertRaises(petri.ArchiveError):
                session.archive(name)

    def test_functions_of_python_cannot_be_recorded(self):
        session = petri.Session("let a=f(1)\n", functions={"f": lambda x: x})
        try:
            recording = session.archive(self.path)
        except petri.ArchiveError as error:
            self.skipTest(str(error))
        session.step()
        with self.assertRaisesRegex(petri.ArchiveError, "of the host cannot be recorded"):
            recording.close()


class Versions(unittest.TestCase):
    def test_a_session_can_follow_an_earlier_specification(self):
        # By specification 0.3, restitution also slows a particle that slides along a barrier.
        script = ("!physics state=:a dimensions=2\n    !particle id=0 velocity=3;0\n"
                  "    !barrier normal=0;1 restitution=0.5\n    !constant acceleration=0;-9\n")
        found = {}
        for spec in None, "0.3":
            session = petri.Session(script, options=petri.Options(spec=spec))
            session.step(30)
            found[session.spec] = session.text("digest")
        self.assertEqual((len(set(found.values())), "0.3" in found), (2, True))
        self.assertEqual(petri.Session("!a\n").spec, petri.__version__.rsplit(".", 1)[0])
        with self.assertRaisesRegex(ValueError, "spec='9'"):
            petri.Session(script, options=petri.Options(spec="9"))

    def test_states_and_archives_keep_a_single_rule_of_an_earlier_specification(self):
        script = ("!physics state=:a dimensions=2\n    !particle id=0 velocity=3;0 mass=2\n"
                  "    !particle id=1 position=3;0\n    !gravity theta=0.5\n"
                  "    !barrier normal=0;1 restitution=0.5\n    !constant acceleration=0;-9\n")
        for spec in "0.3 barriers", "0.3 theta":
            options = petri.Options(spec=spec)
            session = petri.Session(script, options=options)
            self.assertEqual(session.spec, spec)
            session.step(5)
            with tempfile.TemporaryDirectory() as folder:
                session.save(f"{folder}/rule.state")
                with open(f"{folder}/rule.state", encoding="utf-8") as file:
                    self.assertIn(f"\nspec {spec}\n", file.read())
                petri.Session(script, options=options).restore(f"{folder}/rule.state")
                try:
                    with session.archive(f"{folder}/rule.petri"):
                        session.step(30)
                except petri.ArchiveError as error:
                    self.skipTest(str(error))
                archive = petri.Archive(f"{folder}/rule.petri")
                self.assertEqual((archive.info["spec"], archive.session(20).spec), (spec, spec))
                self.assertEqual(list(archive.verify())[-1], 34)


class StepForces(unittest.TestCase):
    """Forces that Python computes in each physics step."""

    SPRING = ("!physics state=:a dimensions=1 resolution=1/600\n    !anchor id=:middle position=0\n"
              "    !particle id=0 position=1 mass=2\n")

    def test_equals_a_spring_of_the_engine_and_the_exact_solution(self):
        calls = []

        def spring(step):
            calls.append((step.name, step.clock))
            return -18 * step.position

        own = petri.Session(self.SPRING, forces={"a": spring})
        engine = petri.Session(self.SPRING + "    !distance from=:middle to=0 strength=18 fixed=0\n")
        for frame in range(121):
            own.step()
            engine.step()
            x, known = own.systems["a"].position[1, 0], engine.systems["a"].position[1, 0]
            self.assertAlmostEqual(x, known, delta=1e-12)
            self.assertAlmostEqual(x, numpy.cos(3 * frame / 60), delta=0.01)  # with one force per frame: 0.3
        self.assertIn(len(calls), range(1200, 1220))
        self.assertEqual(calls[0], ("a", 0))

    def test_gravity_in_numpy_keeps_momentum_and_is_that_of_the_engine(self):
        script = ("!physics state=:sky dimensions=2 resolution=1/240\n    for i in ..40\n"
                  "        !particle id=i mass=1+i%3 position=30*uniform(:p;i)[..2] velocity=uniform(:v;i)[..2]-0.5\n")

        def gravity(step):
            apart = step.position[None, :, :] - step.position[:, None, :]
            cube = (apart ** 2).sum(axis=2) ** 1.5
            numpy.fill_diagonal(cube, 1)
            return (step.mass[:, None, None] * step.mass[None, :, None] * apart / cube[:, :, None]).sum(axis=1)

        own = petri.Session(script, forces={":sky": gravity})
        engine = petri.Session(script + "    !gravity strength=1\n")
        own.step(60)
        engine.step(60)
        numpy.testing.assert_allclose(own.systems["sky"].position, engine.systems["sky"].position, rtol=1e-9)
        start = (engine.systems["sky"].mass[:, None] * (numpy.array(
            [engine.evaluate(f"uniform(:v;{i})[..2]-0.5") for i in range(40)]))).sum(axis=0)
        numpy.testing.assert_allclose(own.systems["sky"].momentum, start, atol=1e-9)

    def test_frames_are_the_same_with_threads_copies_and_rewinds(self):
        def swirl(step):
            return 5 * step.position[:, ::-1] * (1, -1) + numpy.sin(3 * step.clock) - step.velocity

        script = ("!physics state=:a dimensions=2 resolution=1/240\n    !collision strength=80\n    for i in ..300\n"
                  "        !particle id=i radius=1 position=2*(i%20);2*(i//20) force=0;-1\n")
        digests = set()
        for threads in 1, 3:
            session = petri.Session(script, forces={"a": swirl}, options=petri.Options(threads=threads))
            session.step(5)
            there, other = session.snapshot(), session.copy()
            for run in session, other, session:
                if run is session:
                    run.rewind(there)
                run.step(10)
                digests.add(run.text("digest"))
        self.assertEqual(len(digests), 1)

    def test_trust_calls_the_force_with_shorter_steps(self):
        session = petri.Session(self.SPRING, forces={"a": lambda step: -18 * step.position})
        [found] = session.trust("$(:a;0)", frames=101)
        self.assertLess(abs(found.value - numpy.cos(3 * found.time)), found.error)
        self.assertLess(found.error, 0.02)
        self.assertAlmostEqual(found.order, 1, delta=0.2)

    def test_a_step_keeps_its_arrays(self):
        seen = []
        session = petri.Session("!physics state=:a dimensions=3\n    for i in ..2\n        !particle id=i position=i "
                                "velocity=1;2;3 mass=4 charge=i radius=5+i\n", forces={"a": seen.append})
        session.step(3)
        first, second = seen[:2]
        self.assertTrue((first.position == [[0, 0, 0], [1, 1, 1]]).all())
        self.assertTrue((second.position > first.position).all())
        self.assertAlmostEqual(second.clock, first.clock + first.delta)
        self.assertEqual(repr(first), "<petri.Step of 'a' at 0 s: 2 particles>")
        with self.assertRaisesRegex(RuntimeError, "mass of a step"):
            first.mass
        numbers = []
        petri.Session("!physics state=:a dimensions=1\n    for i in ..2\n        !particle id=i mass=4 charge=i radius=5+i\n",
                      forces={"a": lambda step: numbers.extend((step.mass, step.charge, step.radius))}).step(2)
        self.assertEqual([list(array) for array in numbers], [[4, 4], [0, 1], [5, 6]])

    def test_errors_undo_the_frame(self):
        wrong = [None]

        def force(step):
            if wrong[0] is not None:
                return wrong[0](step)

        session = petri.Session(self.SPRING, forces={"a": force}, options=petri.Options(keep_forces=True))
        session.step(3)
        before = session.text("digest")
        for wrong[0], error in ((lambda step: 1 / 0, ZeroDivisionError), (lambda step: [1, 2, 3], ValueError),
                                (lambda step: "x", ValueError), (lambda step: session.frame, RuntimeError),
                                (lambda step: session.close(), RuntimeError)):
            with self.assertRaises(error):
                session.step(5)
            self.assertEqual((session.frame.number, session.text("digest")), (2, before))
        wrong[0] = lambda step: -step.position
        session.step()
        self.assertEqual(session.frame.number, 3)
        first = session.systems["a"].explain(0, 0)
        self.assertEqual((first.sum, first.contributions[0].kind), (-first.position, ""))
        wrong[0] = lambda step: 1 / 0
        with self.assertRaises(ZeroDivisionError):
            session.systems["a"].explain(0)
        with self.assertRaises(TypeError):
            petri.Session(self.SPRING, forces={"a": 5})

    def test_forces_that_are_not_finite_are_reported(self):
        session = petri.Session(self.SPRING, forces={"a": lambda step: step.position / 0 / numpy.abs(step.position)})
        with numpy.errstate(all="ignore"), self.assertWarnsRegex(petri.PetriWarning, "particle number 1 of :a is not finite"):
            session.step(2)

    def test_a_name_without_a_system_is_reported(self):
        session = petri.Session(self.SPRING, forces={"b": lambda step: None})
        with self.assertWarnsRegex(petri.PetriWarning, r"forces\['b'\] has no effect yet.*systems: 'a'"):
            session.step()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            session.step(10)

    def test_cannot_be_recorded(self):
        session = petri.Session(self.SPRING, forces={"a": lambda step: None})
        with tempfile.TemporaryDirectory() as folder:
            try:
                recording = session.archive(Path(folder) / "a.petri")
            except petri.ArchiveError as error:
                self.skipTest(str(error))
            session.step()
            with self.assertRaisesRegex(petri.ArchiveError, "of the host cannot be recorded"):
                recording.close()


class Notebooks(unittest.TestCase):
    """What one uses in notebooks: parameters, copies, trajectories, films."""

    KNOBS = ("let COUNT=COUNT or 3 -- 1..9|1 how many\nlet SPEED=SPEED or 0.5 -- 0..1 of each\n"
             "!physics state=:a dimensions=2 run=1\n    for i in ..COUNT\n        !particle id=i velocity=SPEED;i\n    !random\n")

    def test_parameters_are_listed_and_set(self):
        session = petri.Session(self.KNOBS, SPEED=0.25)
        self.assertEqual(list(session.parameters), ["COUNT", "SPEED"])
        count, speed = session.parameters.values()
        self.assertEqual((count.number, count.min, count.max, count.step, count.comment), (3, 1, 9, 1, "how many"))
        self.assertEqual((speed.value, speed.default, speed.step, speed.settable), ("0.25", "0.5", None, True))
        session.parameters["COUNT"] = 5
        session.step()
        self.assertEqual(len(session.systems["a"]), 5)
        session.parameters["COUNT"] = None
        self.assertEqual(session.parameters["COUNT"].number, 3)
        with self.assertRaises(KeyError):
            session.parameters["OTHER"]
        with self.assertRaises(petri.ScriptError):
            session.parameters["OTHER"] = 1

    def test_copies_continue_bit_for_bit(self):
        session = petri.Session(self.KNOBS, COUNT=4, given={"wind": 2}, functions={"twice": twice})
        session.step(5)
        session.set_parameter("SPEED", 0.75)
        session.set_global("wind", 3)
        session.step(5)
        for other in (session.copy(), copy.copy(session), copy.deepcopy(session), pickle.loads(pickle.dumps(session))):
            self.assertEqual(other.frame.number, session.frame.number)
            self.assertEqual(other.text("state"), session.text("state"))
            self.assertEqual(other.parameters["SPEED"].number, 0.75)
            self.assertEqual(other.evaluate("wind"), 3)
            self.assertEqual(other.evaluate("twice(4)"), 8)
        ahead = session.copy()
        ahead.step(7)
        session.step(7)
        self.assertEqual(ahead.text("digest"), session.text("digest"))
        session.step()  # the copy is independent
        self.assertEqual(ahead.frame.number, session.frame.number - 1)

    def test_exceptions_of_functions_have_their_traceback(self):
        def divide(x):
            return x / 0

        session = petri.Session("!x y=divide(1)\n", functions={"divide": divide})
        try:
            session.step()
            names = []
        except ZeroDivisionError as error:  # assertRaises would remove the traceback
            names = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertIn("divide", names)

    def test_closed_sessions_say_so(self):
        session = petri.Session(self.KNOBS)
        session.close()
        for use in (session.step, lambda: session.evaluate("1"), lambda: list(session.parameters), session.copy):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()

    def test_unknown_sections_are_errors(self):
        with self.assertRaisesRegex(ValueError, "no such section: 'bogus'"):
            petri.Session(self.KNOBS).text("bogus")

    def test_number_returns_a_number(self):
        session = petri.Session(self.KNOBS)
        session.step()
        self.assertEqual(session.number("COUNT+1"), 4.0)
        with self.assertRaises(ValueError):
            session.number("1;2")

    def test_trajectories_have_every_frame(self):
        script = ("let N=(2 if frame < 2 else 3)\n!physics state=:t dimensions=2\n    for i in ..N\n"
                  "        !particle id=i position=i;0 velocity=0;1 mass=2\n    !constant acceleration=0;-1\n")
        path, session = petri.Session(script).record("t", 6), petri.Session(script)
        self.assertEqual(path.position.shape, (6, 3, 2))
        self.assertEqual(path.ids, [0, 1, 2])
        self.assertEqual(repr(path), "<petri.Trajectory of 't': 6 frames, 3 particles, 2 dimensions>")
        for t in range(6):
            session.step()
            system = session.systems["t"]
            self.assertEqual((path.frame[t], path.time[t]), (session.frame.number, session.frame.time))
            numpy.testing.assert_array_equal(path.position[t, :len(system)], system.position)
            numpy.testing.assert_array_equal(path.velocity[t, :len(system)], system.velocity)
            self.assertEqual(path.potential_energy[t], system.potential_energy)
            self.assertEqual(path.kinetic_energy[t], system.kinetic_energy)
            self.assertEqual(numpy.isnan(path.position[t, 2]).all(), len(system) == 2)
        sparse = petri.Session(script).record("t", 6, every=2, energies=False)
        numpy.testing.assert_array_equal(sparse.frame, path.frame[::2])
        self.assertTrue(numpy.isnan(sparse.potential_energy).all())

    def test_pictures_keep_their_shape(self):
        session = petri.Session(RED)
        session.step()
        self.assertEqual(session.picture(width=40).pixels.shape, (20, 40, 4))
        self.assertEqual(session.picture(height=5).pixels.shape, (5, 10, 4))

    def test_animations_play_in_notebooks(self):
        animation = petri.Session(RED).animate(4, every=2, width=8)
        self.assertEqual(len(animation.pictures), 2)
        self.assertEqual(animation.fps, 30)
        self.assertTrue(all(picture.startswith(b"\x89PNG") for picture in animation.pictures))
        self.assertIn(base64.b64encode(animation.pictures[1]).decode(), animation._repr_html_())

    @unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed")
    def test_films_have_their_frames(self):
        for name in ("film.mp4", "film.gif"):
            with tempfile.TemporaryDirectory() as folder:
                file = os.path.join(folder, name)
                petri.Session(RED).film(file, 12, every=2, fps=25, width=64)
                probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                        "stream=width,height,nb_read_frames,r_frame_rate", "-of", "csv=p=0", file],
                                       stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
                self.assertEqual(probe, "64,32,25/1,6")
        with tempfile.TemporaryDirectory() as folder:  # viewers show delays of 1/100 s as 1/10 s
            file = Path(folder) / "fast.gif"
            petri.Session(RED).film(file, 30, width=8)
            delays = [struct.unpack("<H", delay)[0] for delay in re.findall(rb"\x21\xf9\x04.(..)", file.read_bytes(), re.S)]
            self.assertEqual(delays, [2] * 25)
        with self.assertRaises(OSError):
            petri.Session(RED).film("/nowhere/film.mp4", 2, width=64)

    def test_widgets_have_sliders(self):
        widgets = types.SimpleNamespace(**{name: unittest.mock.MagicMock() for name in
                                           ("Image", "Label", "IntSlider", "FloatSlider", "Button", "VBox", "HBox")})
        session = petri.Session(self.KNOBS)
        with unittest.mock.patch.dict(sys.modules, ipywidgets=widgets):
            session.widget(3)
        self.assertEqual(session.frame.number, 2)
        self.assertEqual(widgets.IntSlider.call_args.kwargs["description"], "COUNT")
        self.assertEqual(widgets.FloatSlider.call_args.kwargs["max"], 1)
        moved = widgets.IntSlider.return_value.observe.call_args.args[0]
        moved({"new": 7})
        self.assertEqual(session.parameters["COUNT"].number, 7)

    def test_reset_and_reload(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.fl"
            file.write_text("!counter state=:n rate=60\n")
            session = petri.Session(file)
            session.step(3)
            file.write_text("!counter state=:n rate=-60\n")
            session.reload()
            session.step()
            self.assertEqual((session.frame.number, round(session.number("$:n"), 9)), (3, 1))
            session.reset()
            self.assertEqual(len(session.state), 0)
            session.step()
            self.assertEqual(session.frame.number, 0)

    def test_all_functions_are_wrapped_or_left_out(self):
        root = Path(__file__).parents[2]
        names = set(re.findall(r"^PETRI_API .*?\b(petri_[a-z0-9_]+)\(", (root / "lib/include/petri.h").read_text(), re.M))
        lines = [line.split(None, 1) for line in (root / "tests/python/left_out.txt").read_text().splitlines() if line[0] != "#"]
        used = {name for file in (root / "src/python").rglob("*") if file.suffix in (".py", ".c")
                for name in re.findall(r"\bpetri_[a-z0-9_]+\b", file.read_text())}
        self.assertGreater(len(names), 40)
        self.assertEqual(sorted(names - used), sorted(name for name, reason in lines))

    def test_sweeps_measure_every_frame_and_select(self):
        table = petri.sweep("let A=A or 1\nlet B=B or 1\n!x y=A\n", {"A": [1, 2], "B": [1, 2]},
                            {"sum": "A+B+frame+wind+twice(1)"}, frames=5, every=2, where=lambda run: run["A"] < run["B"],
                            given={"wind": 10}, functions={"twice": twice})
        self.assertEqual(table, {"A": [1, 1, 1], "B": [2, 2, 2], "frame": [0, 2, 4], "sum": [15, 17, 19], "error": [None] * 3})

    def test_warnings_of_sweeps_are_not_repeated(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            table = petri.sweep("let A=A or 1\n!x y=A z=nowhere\n", {"A": range(1, 20)}, {"a": "A"}, frames=2)
        self.assertEqual(table["a"], list(range(1, 20)))
        self.assertEqual([str(warning.message) for warning in caught], ["unbound name 'nowhere' is null [unbound-name]"])

    def test_ctrl_c_aborts_sweeps(self):
        program = ("import os, petri, signal, threading\n"
                   "threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
                   "try:\n    petri.sweep('let A=A or 1\\n!x y=sum(i for i in ..10000000)\\n', {'A': range(1, 9)}, {'a': 'A'}, frames=10**6)\n"
                   "except KeyboardInterrupt:\n    print('aborted')\n")
        done = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.stdout, "aborted\n")


def twice(x):
    return 2 * x


if __name__ == "__main__":
    unittest.main(verbosity=0)
