# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""The module qwsm on the log of a simulated drive."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import qwsm

LOG = os.environ["QWSM_TEST_LOG"]


def scan_of(ranges_m):
    step_rad = float(np.radians(1.0))
    geometry = qwsm.LaserGeometry(
        first_bearing_rad=-90 * step_rad, bearing_step_rad=step_rad, range_max_m=30.0)
    return qwsm.LaserScan(ranges_m, geometry)


def room_from(x_m, y_m, theta_rad):
    """What a laser of 181 beams measures in an empty room of 6 x 4 metres."""
    angles = theta_rad + np.radians(np.arange(-90.0, 91.0))
    with np.errstate(divide="ignore"):
        to_x = (np.copysign(3.0, np.cos(angles)) - x_m) / np.cos(angles)
        to_y = (np.copysign(2.0, np.sin(angles)) - y_m) / np.sin(angles)
    return scan_of(np.minimum(to_x, to_y))


class Scans(unittest.TestCase):
    def test_ranges_are_seen_and_not_copied(self):
        scan = scan_of([1.0, 2.0, 3.0])
        first, second = scan.ranges_m, scan.ranges_m
        self.assertEqual(first.dtype, np.float32)
        self.assertTrue(np.shares_memory(first, second))
        self.assertFalse(first.flags.writeable)

    def test_a_view_outlives_its_scan(self):
        ranges_m = scan_of(np.full(1000, 7.0)).ranges_m
        self.assertTrue((ranges_m == 7.0).all())

    def test_a_table_is_no_scan(self):
        with self.assertRaisesRegex(ValueError, "one dimension"):
            scan_of([[1.0, 2.0]])


class Matching(unittest.TestCase):
    def test_finds_the_motion_between_two_scans(self):
        true = qwsm.Pose2(0.20, 0.05, np.radians(6.0))
        match = qwsm.match_scans(room_from(0, 0, 0), room_from(*true))
        self.assertEqual(match.status, "converged")
        np.testing.assert_allclose(list(match.T_ref_cur), list(true), atol=0.01)
        self.assertEqual(match.covariance.shape, (3, 3))

    def test_a_guess_may_be_numbers_or_a_pose_or_uncertain(self):
        scans = room_from(0, 0, 0), room_from(0.2, 0.0, 0.0)
        uncertain = qwsm.UncertainPose2((0.2, 0, 0), 0.01 * np.eye(3))
        for guess in (0.2, 0, 0), np.array([0.2, 0, 0]), qwsm.Pose2(0.2), uncertain:
            self.assertAlmostEqual(qwsm.match_scans(*scans, guess).T_ref_cur.x_m, 0.2, delta=0.01)


    def test_a_guess_that_is_no_pose_is_told(self):
        scan = room_from(0, 0, 0)
        for guess in (np.nan, 0, 0), (1e300, 0, 0), (0, 0, np.inf):
            with self.assertRaisesRegex(ValueError, "guess: the pose is not finite"):
                qwsm.match_scans(scan, scan, guess)
        for covariance in np.full((3, 3), np.nan), -np.eye(3):
            with self.assertRaisesRegex(ValueError, "guess: the covariance is not finite, or its"):
                qwsm.match_scans(scan, scan, qwsm.UncertainPose2((0, 0, 0), covariance))


class Poses(unittest.TestCase):
    def test_headings_are_within_half_a_turn(self):
        pose, turn = qwsm.Pose2(0, 0, 7.0), 7.0 - 2 * np.pi
        self.assertAlmostEqual(pose.theta_rad, turn)
        self.assertAlmostEqual(qwsm.Pose2((0, 0, 7.0)).theta_rad, turn)
        pose.theta_rad = -7.0
        self.assertAlmostEqual(pose.theta_rad, -turn)


class Quadtree(unittest.TestCase):
    def test_finds_what_brute_force_finds(self):
        random = np.random.default_rng(1)
        points, queries = random.uniform(0, 5, (2000, 2)), random.uniform(0, 5, (100, 2))
        tree = qwsm.PointQuadtree(1e-5)
        tree.insert(points)
        ids, distances = tree.nearest(queries, 10.0)
        expected = np.linalg.norm(queries[:, None] - points, axis=2)
        np.testing.assert_allclose(distances, expected.min(axis=1), atol=1e-6)
        found = np.linalg.norm(tree.positions(ids) - queries, axis=1)
        np.testing.assert_allclose(found, distances, atol=1e-6)

    def test_nothing_near_is_infinitely_far(self):
        tree = qwsm.PointQuadtree()
        tree.insert([[0.0, 0.0]])
        ids, distances = tree.nearest([[9.0, 9.0]], 1.0)
        self.assertEqual((ids[0], distances[0]), (tree.id_end, np.inf))

    def test_areas_and_removal(self):
        tree = qwsm.PointQuadtree()
        tree.insert([[0.1 * i, 2.0] for i in range(100)], scan=0)
        tree.insert([[0.1 * i + 0.05, 2.0] for i in range(100)], scan=1)
        self.assertEqual(len(tree.in_radius((5.0, 2.0), 0.12)), 5)
        self.assertEqual(len(tree.in_box((0.99, 1.0), (1.26, 3.0))), 6)
        self.assertEqual(tree.remove_scan(1), 100)
        self.assertEqual(len(tree.points()), 100)
        self.assertEqual(len(tree.k_nearest((0.0, 2.0), 3, 1.0)[0]), 3)

    def test_bad_input_is_told(self):
        tree = qwsm.PointQuadtree()
        with self.assertRaisesRegex(ValueError, r"points_m\[1\] is not finite"):
            tree.insert([[0.0, 0.0], [np.nan, 0.0]])
        with self.assertRaisesRegex(ValueError, "scan must be below 2147483647, not 4294967295"):
            tree.insert([[0.0, 0.0]], scan=2**32 - 1)
        with self.assertRaisesRegex(ValueError, r"shape \(n, 2\), not \(1, 3\)"):
            tree.nearest([[1.0, 2.0, 3.0]], 1.0)
        with self.assertRaisesRegex(IndexError, "no point 7"):
            tree.positions([7])
        with self.assertRaisesRegex(IndexError, "no point 7"):
            tree.scan(7)


class Logs(unittest.TestCase):
    def test_readings_come_in_their_order(self):
        reader = qwsm.read_log(LOG)
        readings = list(reader)
        scans = [r.scan for r in readings if isinstance(r, qwsm.ScanReading)]
        self.assertEqual(len(scans), reader.report.scans)
        self.assertTrue((np.diff([scan.stamp_ns for scan in scans]) > 0).all())
        self.assertEqual(reader.report.format, "CARMEN")

    def test_what_is_no_log_is_told(self):
        with self.assertRaisesRegex(qwsm.LogError, "qwsm_test.py: this is no robot log"):
            qwsm.map_log(__file__)
        with self.assertRaisesRegex(qwsm.LogError, "nowhere.log: cannot be opened"):
            qwsm.read_log("nowhere.log")

    def test_what_can_be_read_around_is_a_warning(self):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            log.write(pathlib.Path(LOG).read_text() + "ODOM 1 2 three 0 0 0 1.0 host 1.0\n")
            log.flush()
            with self.assertWarnsRegex(UserWarning, "ODOM"):
                qwsm.map_log(log.name, correct=False)


class Mapping(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mapped = qwsm.map_log(LOG)

    def test_paths_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            program = [os.environ["QWSM_PROGRAM"], "map", LOG, "--quiet", "--output"]
            subprocess.run([*program, f"{folder}/run"], check=True)
            for path, name in (self.mapped.trajectory, ""), (self.mapped.live, "_live"):
                path.save(f"{folder}/path.tum")
                ours = pathlib.Path(folder, "path.tum").read_bytes()
                theirs = pathlib.Path(folder, "run", f"trajectory{name}.tum").read_bytes()
                self.assertEqual(ours, theirs)

    def test_absurd_odometry_is_refused(self):
        scan = next(r.scan for r in qwsm.read_log(LOG) if isinstance(r, qwsm.ScanReading))
        for pose in (float("nan"), 0, 0), (1e300, 0, 0):
            with self.assertRaisesRegex(ValueError, "T_odom_robot must be finite"):
                qwsm.Mapper().process(scan, pose)

    def test_scan_by_scan_is_the_live_path(self):
        mapper = qwsm.Mapper()
        readings = (r for r in qwsm.read_log(LOG) if isinstance(r, qwsm.ScanReading))
        steps = [mapper.process(r.scan, r.T_odom_robot) for r in readings]
        poses = np.array([list(step.map_robot.T_a_b) for step in steps])
        np.testing.assert_array_equal(poses, self.mapped.live.poses)
        self.assertEqual(steps[0].status, "first")
        self.assertEqual(len(mapper.map), sum(step.relevant for step in steps))

    def test_arrays_are_views(self):
        for path in self.mapped.trajectory, self.mapped.live:
            self.assertTrue(np.shares_memory(path.poses, path.poses))
            self.assertEqual(path.poses.shape, (len(path), 3))
            self.assertEqual(path.stamps_ns.dtype, np.int64)
        covariances = self.mapped.covariances
        self.assertEqual(covariances.shape, (len(self.mapped.trajectory), 3, 3))
        np.testing.assert_allclose(covariances, covariances.transpose(0, 2, 1), atol=1e-12)

    def test_is_near_the_truth(self):
        truth = qwsm.read_trajectory(f"{LOG}.truth.tum")
        error = qwsm.absolute_trajectory_error(truth, self.mapped.trajectory)
        self.assertGreater(error.count, 10)
        self.assertLess(error.rmse, 0.03)

    def test_a_map_is_saved_loaded_and_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            self.mapped.map.save(f"{folder}/two-rooms.qwsm")
            loaded = qwsm.load_map(f"{folder}/two-rooms.qwsm")
        points = self.mapped.map.quadtree.points()
        np.testing.assert_array_equal(loaded.quadtree.points(), points)
        grid = loaded.occupancy({"cell_m": 0.1})
        left, right, bottom, top = grid.extent_m
        self.assertEqual(grid.cells.shape, (round((top - bottom) / 0.1), round((right - left) / 0.1)))
        self.assertEqual(set(np.unique(grid.cells)), {0, 1, 2})

    def test_relations_are_evaluated(self):
        path = self.mapped.trajectory
        t0, t1 = 1e-9 * path.stamps_ns[[0, -1]]
        x, y, theta = list(qwsm.Pose2(path.poses[0]).inverse() * qwsm.Pose2(path.poses[-1]))
        with tempfile.NamedTemporaryFile("w") as file:
            file.write(f"{t0:.9f} {t1:.9f} {x + 0.5} {y} 0 0 0 {theta}\n")
            file.flush()
            result = qwsm.evaluate_relations(qwsm.read_relations(file.name), path)
        self.assertAlmostEqual(result.all.translation_m.mean, 0.5, places=6)

    def test_options_are_those_of_the_program(self):
        wsm = qwsm.map_log([LOG], {"matcher": "wsm", "motion": {"rotation_per_rotation": 0.2}})
        self.assertFalse(np.array_equal(wsm.trajectory.poses, self.mapped.live.poses))
        with self.assertRaisesRegex(qwsm.OptionError, "option motoin: unknown.*'motion'"):
            qwsm.Mapper({"motoin": 1, "matcher": "wsm"})


if __name__ == "__main__":
    unittest.main()
