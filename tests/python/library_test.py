"""The Python library as a user has it: numpy in and out, sessions, parts, Ctrl-C, threads, records."""

import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import numpy as np

import kreisel as kr


def box(edges=(40.0, 30.0, 24.0), centre=(0, 0, 0)):
    """A closed box: vertices (8, 3), faces (12, 3)."""
    corners = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]) / 2
    faces = np.array([(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7),
                      (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)])
    return corners * edges + centre, faces


class Lowest(kr.Problem):
    """The lowest centre of mass of a given share of the mass: what lies below a plane."""

    def __init__(self, share):
        unit = np.eye(10)
        self.share = share
        self.rows = [("mass", unit[kr.S1], share, share), ("cx", unit[kr.SX], 0, 0), ("cy", unit[kr.SY], 0, 0)]

    def value(self, s):
        return s[kr.SZ] / self.share

    def gradient(self, s):
        return np.eye(10)[kr.SZ] / self.share

    def verify(self, s, length_mm):
        return abs(s[kr.S1] / self.share - 1) < 1e-3, f"{length_mm * s[kr.SZ] / s[kr.S1]:.3f} mm up"


class High(Lowest):
    """The same, and the better the higher it is in its pose."""

    def verify(self, s, length_mm):
        return True, "is"

    def pose_loss(self, s):
        return -s[kr.SZ] / s[kr.S1]


class WithinACircle(Lowest):
    """As far to +x as a circle about the axis allows: a row that is not linear."""

    def __init__(self, share, radius):
        super().__init__(share)
        self.rows = self.rows[:1]
        self.limits = [(-np.inf, radius ** 2)]

    def value(self, s):
        return -s[kr.SX]

    def gradient(self, s):
        return -np.eye(10)[kr.SX]

    def nonlinear(self, s):
        return np.array([(s[kr.SX] ** 2 + s[kr.SY] ** 2) / s[kr.S1] ** 2])

    def jacobian(self, s):
        row = np.zeros((1, 10))
        row[0, [kr.S1, kr.SX, kr.SY]] = (-2 * self.nonlinear(s)[0] / s[kr.S1], 2 * s[kr.SX] / s[kr.S1] ** 2,
                                        2 * s[kr.SY] / s[kr.S1] ** 2)
        return row

    def curvature(self, s, multipliers):
        h, m = np.zeros((10, 10)), s[kr.S1]
        h[kr.S1, kr.S1] = 6 * self.nonlinear(s)[0] / m ** 2
        for k in (kr.SX, kr.SY):
            h[k, k] = 2 / m ** 2
            h[k, kr.S1] = h[kr.S1, k] = -4 * s[k] / m ** 3
        return multipliers[0] * h


class Problems(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kr.add_problem("py-lowest", lambda settings, body: Lowest(float(settings.get("mass", 0.6))), upright=True)
        kr.add_problem("py-circle", lambda settings, body: WithinACircle(0.6, 0.05), upright=True)

    def test_is_solved_and_made_into_a_part_that_does_it(self):
        session = kr.Session(kr.Body(*box()))
        answer = session.solve("py-lowest", settings={"problem.mass": 0.5}, cells=48)
        self.assertEqual(answer.end, "optimal")
        length = answer.length_mm
        # Moments are g, g mm, ...; half of a box of 28.8 g at 1 g/cm^3, above its middle and as low as walls allow.
        self.assertAlmostEqual(answer.moments[0], 0.5 * 40 * 30 * 24e-3, delta=1e-6)
        self.assertLess(answer.objective * length, 12)
        self.assertTrue(answer.verdict)
        part = session.part(answer)
        self.assertTrue(part.verdict, part.verdict.text)
        self.assertIn("mm up", part.verdict.text)

    def test_a_pose_is_found_by_what_the_problem_says(self):
        session = kr.Session(kr.Body(*box()))
        stands = session.solve("stand", find="auto", settings={"problem.target": "max-tilt"}, cells=32)
        self.assertTrue(stands.verdict, stands.message)
        np.testing.assert_allclose(np.abs(stands.question.up), [0, 0, 1], atol=1e-9)  # on its widest face
        kr.add_problem("py-high", lambda settings, body: High(0.6), upright=True, poses="any")
        high = session.solve("py-high", find="auto", cells=32)
        # Its own loss: as far up as any direction lets the centre of mass be, along the longest edge or beyond it.
        self.assertGreater(abs(high.question.up[0]), 0.5)
        with self.assertRaises(kr.InputError):
            session.solve("balance", find="auto", settings={"problem.point": (0, 0, 0)})
        with self.assertRaises(kr.InputError):
            kr.add_problem("py-none", lambda settings, body: High(0.6), poses="some")

    def test_agrees_with_ray_reps_by_ipopt(self):
        session = kr.Session(kr.Body(*box()))
        exact = session.solve("py-lowest", cells=32)
        rays = session.solve("py-lowest", formulation="rayrep", cells=32)
        self.assertEqual((exact.end, rays.end), ("optimal", "optimal"))
        # Columns keep up to half a cell less than the exact wall: 1.25 mm of 30.7, times what that moves.
        self.assertAlmostEqual(exact.objective, rays.objective, delta=0.02)

    def test_nonlinear_rows_are_met_by_ipopt_and_refused_by_others(self):
        session = kr.Session(kr.Body(*box()))
        answer = session.solve("py-circle", formulation="rayrep", cells=32)
        self.assertEqual(answer.end, "optimal")
        self.assertAlmostEqual(-answer.objective, 0.05 * 0.6, delta=1e-6)
        with self.assertRaisesRegex(kr.InputError, "nonlinear rows of problem 'py-circle'.*expected solver ipopt"):
            session.solve("py-circle")

    def test_names_are_taken_once(self):
        for name in ("py-lowest", "spin", ""):
            with self.assertRaises(kr.InputError):
                kr.add_problem(name, lambda settings, body: Lowest(0.5))

    def test_what_a_problem_raises_arrives(self):
        class Broken(Lowest):
            def value(self, s):
                raise ZeroDivisionError("of mine")

        class Crooked(Lowest):
            def gradient(self, s):
                return np.zeros(3)

        kr.add_problem("py-broken", lambda settings, body: Broken(0.5), upright=True)
        kr.add_problem("py-crooked", lambda settings, body: Crooked(0.5), upright=True)
        kr.add_problem("py-none", lambda settings, body: None)
        session = kr.Session(kr.Body(*box()))
        for formulation in ("quadric", "rayrep"):
            with self.assertRaisesRegex(ZeroDivisionError, "of mine"):
                session.solve("py-broken", formulation=formulation, cells=32)
            with self.assertRaisesRegex(kr.InputError, "gradient.*expected"):
                session.solve("py-crooked", formulation=formulation, cells=32)
        with self.assertRaises(AttributeError):
            session.solve("py-none", cells=16)
        self.assertEqual(session.solve("py-lowest", cells=16).end, "optimal")

    def test_may_keep_the_body_it_was_asked_of(self):
        kept = []

        def make(settings, body):
            kept.append(body)
            return Lowest(0.6)

        kr.add_problem("py-keeps", make, upright=True)
        session = kr.Session(kr.Body(*box()))
        answer = session.solve("py-keeps", cells=16)
        del session
        np.testing.assert_allclose(kept[0].solid[0], 1, rtol=1e-12)
        self.assertEqual(kept[0].vertices.shape, (8, 3))
        self.assertAlmostEqual(kept[0].length_mm, answer.length_mm)


class Inspections(unittest.TestCase):
    def test_weighs_a_box_in_closed_form(self):
        seen = kr.inspect(*box((10, 20, 30)), density=2)
        self.assertTrue(seen)
        self.assertAlmostEqual(seen.solid.volume, 6000)
        self.assertAlmostEqual(seen.solid.mass, 12)
        np.testing.assert_allclose(seen.solid.principal, (500, 1000, 1300), rtol=1e-12)
        self.assertEqual([s.genus for s in seen.shells], [0])
        self.assertFalse(seen.solid.verdicts["spin"])

    def test_says_what_is_wrong_without_raising(self):
        vertices, faces = box()
        seen = kr.inspect(vertices, faces[:-1])
        self.assertFalse(seen)
        self.assertEqual(seen.checks["open_edges"], 3)
        self.assertIn("watertight", seen.error)
        self.assertIsNone(seen.solid)
        with self.assertRaises(kr.InputError):
            kr.inspect("no-such-file.off")


class Bodies(unittest.TestCase):
    def test_moments_of_a_box_are_in_closed_form(self):
        a, b, c = 40.0, 30.0, 24.0
        s = kr.Body(*box((a, b, c), (1, 2, 3))).moments()
        v = a * b * c
        expected = [v, v, 2 * v, 3 * v, 2 * v, 6 * v, 3 * v,
                    v * (1 + a * a / 12), v * (4 + b * b / 12), v * (9 + c * c / 12)]
        np.testing.assert_allclose(s, expected, rtol=1e-13)

    def test_the_mesh_is_a_read_only_view(self):
        vertices, faces = box()
        body = kr.Body(vertices, faces)
        seen, triangles = body.mesh
        self.assertEqual((seen.dtype, triangles.dtype), (np.float64, np.uint32))
        self.assertFalse(seen.flags.owndata)
        self.assertFalse(seen.flags.writeable)
        del body  # the view keeps it
        np.testing.assert_array_equal(seen, vertices)
        np.testing.assert_array_equal(triangles, faces)

    def test_any_array_layout_will_do(self):
        vertices, faces = box()
        for v, f in ((np.asfortranarray(vertices), faces.astype(np.int32)), (vertices.tolist(), faces.tolist())):
            self.assertAlmostEqual(kr.Body(v, f).moments()[0], 40 * 30 * 24)
        self.assertAlmostEqual(kr.Body(vertices.astype(np.float32), faces[:, ::1]).moments()[0], 40 * 30 * 24)

    def test_what_is_no_solid_is_refused_in_one_line(self):
        vertices, faces = box()
        wrong = faces.copy()
        wrong[3, 1] = -1
        for v, f, says in ((vertices, faces[:-1], "watertight"), (vertices, wrong, "face 3 of the vertex -1"),
                           (vertices[:, :2], faces, "vertices of shape 8 x 2"), (vertices * np.nan, faces, "")):
            with self.assertRaises(kr.InputError) as caught:
                kr.Body(v, f)
            self.assertIn(says, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaises(ValueError):
            kr.Body.read("no-such-file.off")
        with self.assertRaises(kr.Error):
            kr.Body.model("ellipsoidd")


class Sessions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.body = kr.Body.model("ellipsoid")
        cls.session = kr.Session(cls.body)

    def test_a_question_makes_only_what_it_changes(self):
        s = kr.Session(self.body)
        first = s.solve("spin", wall=1.2, cells=32)
        self.assertEqual(s.made, ["body", "domain", "problem", "formulation"])
        self.assertEqual(first.end, "optimal")
        again = s.solve(first.question)
        self.assertEqual((s.made, again.objective), ([], first.objective))
        weighted = s.solve(first.question, settings={"problem.gamma_i": 2}).question
        self.assertEqual(s.made, ["problem"])
        self.assertEqual(s.solve(weighted, settings={}).objective, first.objective)
        self.assertEqual(s.solve(weighted, problem="stand").question.problem, "stand")
        s.solve(first.question.replace(wall=1.6))
        self.assertIn("domain", s.made)
        turned = s.solve(first.question.replace(wall=1.6, axis=(0.1, 0, 1)))
        self.assertEqual(s.made, ["pose", "problem"])
        cold = kr.Session(self.body).solve(turned.question)
        self.assertAlmostEqual(turned.objective, cold.objective, delta=0.02 * cold.objective)

    def test_the_moments_and_the_quadric_are_those_of_the_optimum(self):
        s = self.session
        a = s.solve("spin", wall=1.2, cells=48, axis=(0.05, 0.02, 1))
        mass, *first = a.moments[:4]
        # The centre of mass lies on the axis through the contact point, the body frame's origin.
        off = np.cross(np.array(first) / mass - a.origin, a.rotation[2])
        self.assertLess(np.linalg.norm(off), 1e-6)
        self.assertTrue(a.verdict)
        self.assertEqual(a.quadric_body.shape, (10,))
        with self.assertRaises(ValueError):
            a.moments[0] = 1
        # Turned by a session whose rays run along z, it is the quadric of a session whose rays run along the axis.
        cold = kr.Session(self.body).solve(a.question).quadric_body
        warm = kr.Session(self.body)
        warm.solve("spin", wall=1.2, cells=48)
        turned = warm.solve(a.question).quadric_body
        self.assertEqual(warm.made, ["pose", "problem"])
        np.testing.assert_allclose(turned / np.abs(turned).max(), cold / np.abs(cold).max(), atol=0.02)

    def test_other_formulations_and_solvers_answer_too(self):
        best = self.session.solve("spin", wall="1.5h", cells=40, domain="columns")
        rays = self.session.solve("spin", wall="1.5h", cells=40, formulation="rayrep",
                                  settings={"ipopt.hessian_approximation": "limited-memory"})
        self.assertEqual(rays.end, "optimal")
        self.assertIsNone(rays.quadric_body)
        self.assertGreater(rays.variables.size, 100)
        self.assertAlmostEqual(rays.objective, best.objective, delta=0.01)

    def test_a_certificate_bounds_the_objective(self):
        a = self.session.solve("spin", wall=1.2, cells=32, certify=1e-3)
        self.assertLessEqual(a.bound, a.objective)
        self.assertLess(a.objective - a.bound, 1.01e-3 * a.objective)
        self.assertIsNone(self.session.solve("spin", wall=1.2, cells=32).bound)
        turned = self.session.solve("spin", wall=1.2, cells=32, axis=(0.05, 0.02, 1), certify=1e-3)
        self.assertLessEqual(turned.bound, turned.objective)

    def test_what_is_infeasible_says_why_and_what_would_help(self):
        a = self.session.solve("spin", wall=8, cells=32, axis=(1, 0.4, 0.3))
        self.assertEqual(a.end, "infeasible")
        self.assertFalse(a.feasible)
        self.assertTrue(a.unmet)
        self.assertIn("wall", self.session.remedies(a))
        with self.assertRaises(kr.InputError):
            self.session.part(a)

    def test_a_part_is_written_and_verified(self):
        a = self.session.solve("spin", wall=1.2, cells=32)
        part = self.session.part(a, accuracy=0.3)
        self.assertTrue(part.verdict.ok)
        self.assertGreaterEqual(part.wall_mm, 1.2 * (1 - 1e-6))
        vertices, faces = part.meshes[0]
        p = vertices[faces]
        volume = np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 1], p[:, 2])).sum() / 6
        self.assertAlmostEqual(volume * 1e-3, part.moments[0], delta=1e-5 * part.moments[0])
        with tempfile.TemporaryDirectory() as folder:
            for name in ("part.stl", "part.3mf", "part.off"):
                files = part.write(os.path.join(folder, name))
                self.assertTrue(kr.verify(files, self.body, a.question).ok, name)
            with self.assertRaises(kr.InputError):
                part.write(os.path.join(folder, "part.xyz"))
            self.assertEqual(len(os.listdir(folder)), 3)
            halves = self.session.part(a, cut="auto", pegs=1)
            files = halves.write(os.path.join(folder, "halves.3mf"))
            self.assertTrue(kr.verify(files, self.body, a.question).ok, "all objects of the file")
            self.assertFalse(kr.verify(halves.write(os.path.join(folder, "halves.stl"))[:1], self.body, a.question).ok)
            with self.assertRaises(kr.InputError):
                kr.verify([os.path.join(folder, "no-such.stl")], self.body, a.question)
        self.assertEqual({"lower", "upper", "peg-1"} - set(halves.names), set())

    def test_a_map_finds_an_axis(self):
        found = self.session.map("spin", axes=50, through="centre", wall=1.2, cells=24)
        self.assertEqual(len(found), 50)
        self.assertEqual(found.axes.shape, (50, 3))
        best = found.best()
        self.assertTrue(found.ok[best.index])
        self.assertAlmostEqual(best.solution.objective, found.objective[best.index], places=5)

    def test_a_question_that_does_not_fit_is_refused_in_one_line(self):
        for fields in ({"wal": 2}, {"wall": "thick"}, {"wall": None}, {"cells": 1.5}, {"axis": (0, 0)},
                       {"problem": "spim"}, {"formulation": "voxels"}, {"settings": {"draft": 1}},
                       {"settings": {"problem.drat": 1}}, {"certify": 2}, {"size": -1}, {"density": "x"}):
            with self.assertRaises(kr.InputError, msg=fields) as caught:
                self.session.solve(kr.Question("spin", cells=16), **fields)
            self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(self.session.solve("spin", cells=16).end, "optimal")

    def test_threads_give_the_same_bits(self):
        def answers(session):
            return [session.solve("spin", cells=24, settings={"problem.gamma_i": 1 + i % 5}).objective
                    for i in range(25)]

        alone, together = answers(kr.Session(self.body)), {}
        threads = [threading.Thread(target=lambda t=t: together.update({t: answers(kr.Session(self.body))}))
                   for t in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(list(together.values()), [alone] * 4)

    def test_one_session_in_two_threads_is_refused(self):
        busy = kr.Session(self.body)
        question = busy.solve("spin", cells=24).question
        long = threading.Thread(target=lambda: busy.map(question, axes=4000))
        long.start()
        time.sleep(0.3)
        self.assertTrue(long.is_alive(), "the map takes seconds")
        with self.assertRaisesRegex(kr.Error, "two threads"):
            busy.solve(question)
        long.join()
        self.assertEqual(busy.solve(question).end, "optimal")

    def test_ctrl_c_stops_a_solve_and_leaves_the_session_usable(self):
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            self.session.map("spin", axes=1000000, cells=48)
        self.assertLess(time.monotonic() - began, 1.5)
        self.assertEqual(self.session.solve("spin", cells=24).end, "optimal")

    def test_a_call_in_a_callback_leaves_ctrl_c_as_it_was(self):
        before = signal.getsignal(signal.SIGINT)
        kr.nest(kr.Body(*box()), free="all", seconds=60,
                on_iteration=lambda it: self.session.solve("spin", cells=16).feasible and False)
        self.assertIs(signal.getsignal(signal.SIGINT), before)
        with self.assertRaises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1)

    def test_a_question_asked_again_makes_nothing(self):
        question = self.session.solve("spin", cells=16).question
        spent = []
        for _ in range(200):
            began = time.perf_counter()
            answer = self.session.solve(question)
            spent.append(time.perf_counter() - began - answer.setup_seconds - answer.solve_seconds)
            self.assertEqual(self.session.made, [])
        print(f"around a solve: {1e6 * np.median(spent):.0f} us")


class Keywords(unittest.TestCase):
    """Of a question: every field that `bench fields solve` has, but for what a session has already."""

    #: A value of each that is taken whatever the rest; any other takes a number.
    VALUES = {"axis": (0, 0, 1), "contact": (0, 0, 1), "up": "near:0,0,1", "axis_through": "centre", "tip": "2,3",
              "problem": "stand", "formulation": "rayrep", "solver": "moment", "domain": "exact", "wall_to": "corners",
              "wall": "2%", "certify": 1e-3, "rounding": "nearest", "cells": (20, 16, 16), "level": 5, "find": "auto",
              "flatten": "auto", "point": (0, 0, 5), "line": (0, 0, 1), "target": "inside", "lower": "height",
              "draft": "60%", "resolution": 20, "deform": "least", "keep": "0,0,5,1"}

    def test_every_field_is_one_and_can_be_read_again(self):
        for keyword, says in kr.question_fields().items():
            question = kr.Question(**{keyword: self.VALUES.get(keyword, 2)})
            self.assertIn(f"{keyword}: {says}", kr.Question.__doc__)
            self.assertTrue(hasattr(question, keyword))

    def test_values_are_numbers_text_or_sequences(self):
        q = kr.Question(axis="auto", axis_through="centre", stem=np.float32(2), tip=(2, 3), flatten="auto",
                        wall="1.5h", resolution=(20, 16, 16), draft="60%", void_density=0.5)
        self.assertEqual((q.axis, q.axis_through, q.stem, q.flatten), ("auto", "centre", 2, "auto"))
        self.assertEqual((list(q.tip), q.wall, q.cells, q.draft, q.void_density),
                         ([2, 3], "1.5h", [20, 16, 16], "60%", 0.5))
        self.assertEqual(kr.Question(settings={"problem.draft": "60%"}), kr.Question(draft="60%"))
        self.assertEqual(list(kr.Question(axis=np.array((0, 1.0, 2))).axis), [0, 1, 2])

    def test_what_is_said_later_stands(self):
        q = kr.Question(level=5, axis="auto", flatten="auto", certify=1e-3)
        self.assertEqual(q.replace(cells=20).resolution, 20)
        self.assertEqual(list(q.replace(axis=(0, 0, 1)).axis), [0, 0, 1])
        self.assertEqual(q.replace(flatten=2).flatten, 2)
        self.assertIsNone(q.replace(flatten=None).flatten)
        self.assertEqual(q.replace(certify=0), q.replace(certify=0).replace(certify=0))
        self.assertEqual(q.replace(level=None, axis=None, flatten=None, certify=0), kr.Question())

    def test_the_librarys_own_defaults_stay(self):
        q = kr.Question()
        self.assertEqual((q.formulation, q.solver, q.domain, q.wall, q.resolution, q.axis),
                         ("quadric", "moment", "exact", 1.2, 64, None))
        self.assertIn("of a question quadric", kr.question_fields()["formulation"])

    def test_what_does_not_fit_is_told_when_it_is_given(self):
        for fields, says in (({"wal": 2}, "did you mean 'wall'?"), ({"flatten": "much"}, "flatten = 'much'; expected mm"),
                             ({"void_density": "x"}, "void_density = 'x'; expected a number"),
                             ({"wall_to": "middle"}, "expected centres or corners"), ({"domain": None}, "domain = 'None'"),
                             ({"axis": (1, 2)}, "axis = '1,2'"), ({"problem": "spim"}, "did you mean 'spin'?"),
                             ({"weld": 0.1}, "weld: a question has no such field"), ({"repeat": 3}, "repeat: ")):
            with self.assertRaises(kr.InputError, msg=fields) as caught:
                kr.Question(**fields)
            self.assertIn(says, str(caught.exception))

    def test_a_session_solves_and_verifies_by_them(self):
        body = kr.Body.model("ellipsoid")
        session = kr.Session(body)
        found = session.solve("spin", axis="auto", axis_through="lowest", wall="2%", cells=24)
        self.assertTrue(found.feasible, found.message)
        self.assertEqual(found.question.axis.shape, (3,))
        self.assertEqual(session.solve(found.question).objective, found.objective)
        exact = session.solve("spin", formulation="rayrep", wall_to="corners", level=4)
        self.assertEqual(exact.question.wall_to, "corners")
        standing = session.solve("stand", flatten="auto", cells=24)
        self.assertGreater(standing.question.flatten or 0, 0)
        with tempfile.TemporaryDirectory() as folder:
            files = session.part(found).write(os.path.join(folder, "part.stl"))
            self.assertTrue(kr.verify(files, body, found.question, rounding="nearest"))
            self.assertTrue(kr.verify(files, body, "spin", axis=found.question.axis, contact=found.question.contact))
            with self.assertRaisesRegex(kr.InputError, "to be found"):
                kr.verify(files, body, "spin", axis="auto")


class Nests(unittest.TestCase):
    def test_a_box_in_itself_nests_as_a_smaller_one(self):
        body = kr.Body(*box((40, 40, 40)))
        told = []
        found = kr.nest(body, body, free="all", seconds=20, iterations=5, particles=8,
                        on_iteration=lambda it: told.append(it.scale))
        self.assertTrue(found.valid)
        self.assertGreater(found.certified_scale, 0.9)
        self.assertTrue(told)
        self.assertEqual(found.transform.shape, (3, 4))

    def test_the_callback_ends_a_search_and_keeps_the_best(self):
        body = kr.Body(*box((40, 40, 40)))
        calls = []

        def two(iteration):
            calls.append(iteration.iteration)
            return len(calls) < 2

        found = kr.nest(body, free="all", seconds=60, on_iteration=two)
        self.assertEqual(len(calls), 2)
        self.assertGreater(found.scale, 0)

        def broken(_):
            raise RuntimeError("mine")

        with self.assertRaisesRegex(RuntimeError, "mine"):
            kr.nest(body, free="all", seconds=60, on_iteration=broken)

    def test_wrong_fields_are_refused(self):
        body = kr.Body(*box())
        for fields in ({"fre": "all"}, {"within": "bunny"}, {"layers": 2}):
            with self.assertRaises(kr.InputError):
                kr.nest(body, **fields)


class Records(unittest.TestCase):
    @unittest.skipUnless("KREISEL_BENCH" in os.environ, "where the program bench lies is not said")
    def test_a_row_is_what_the_session_answers(self):
        with tempfile.TemporaryDirectory() as folder:
            for wall in ("1.2", "2.4"):
                subprocess.run([os.environ["KREISEL_BENCH"], "--formulation", "quadric", "--wall", wall, "--resolution",
                                "32", "--record", os.path.join(folder, f"{wall}.h5")], check=True,
                               stdout=subprocess.DEVNULL)
            rows = kr.records(folder)
        session = kr.Session(kr.Body.model("ellipsoid"))
        self.assertEqual(len(rows), 2)
        for row, wall in zip(rows, (1.2, 2.4)):
            self.assertEqual(row["objective"], session.solve("spin", wall=wall, cells=32).objective)
            self.assertEqual((row["model"], row["config.wall"]), ("ellipsoid", f"{wall}"))

    def test_folders_without_records_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(kr.BadRecord):
                kr.records(folder)
            pathlib.Path(folder, "x.h5").write_bytes(b"no HDF5")
            with self.assertRaises(kr.BadRecord):
                kr.records(folder)


if __name__ == "__main__":
    unittest.main()
