# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""The module slam6d on scans of a simulated hall."""

import tempfile
import threading
import unittest

import numpy as np

import slam6d


def pose(x_m, y_m, yaw_rad):
    T = np.eye(4)
    T[:2, :2] = [[np.cos(yaw_rad), -np.sin(yaw_rad)], [np.sin(yaw_rad), np.cos(yaw_rad)]]
    T[:2, 3] = x_m, y_m
    return T


def hall_from(T_hall_scanner, seed, points=10_000):
    """Points on floor, ceiling and walls of a hall of 8 x 6 x 3 metres, off by a centimetre."""
    random = np.random.default_rng(seed)
    place = random.uniform(-1.0, 1.0, (points, 3))
    rows = np.arange(points)
    place[rows, rows % 3] = np.sign(place[rows, rows % 3])
    p_hall = place * [4.0, 3.0, 1.5] + random.normal(0.0, 0.01, place.shape)
    inverse = np.linalg.inv(T_hall_scanner)
    return p_hall @ inverse[:3, :3].T + inverse[:3, 3]


class Registration(unittest.TestCase):
    first, motion = pose(0.5, -0.4, 0.0), pose(0.3, 0.1, 0.087)

    def test_aligns_two_clouds(self):
        ref = slam6d.ScanModel(hall_from(self.first, 1))
        cur = slam6d.ScanModel(hall_from(self.first @ self.motion, 2))
        result = slam6d.align(ref, cur)
        self.assertEqual(result.status, "converged")
        np.testing.assert_allclose(result.T_ref_cur, self.motion, atol=0.005)
        self.assertEqual(result.covariance.shape, (6, 6))

    def test_places_scans_in_one_map(self):
        slam = slam6d.Slam({"icp": {"threads": 2}})
        slam.add(hall_from(self.first, 1), np.eye(4))
        step = slam.add(hall_from(self.first @ self.motion, 2), pose(0.25, 0.15, 0.06))
        slam.refine()
        self.assertEqual(step.status, "matched")
        np.testing.assert_allclose(slam.poses[1], self.motion, atol=0.005)

    def test_bad_input_is_told(self):
        with self.assertRaisesRegex(ValueError, r"shape \(n, 3\), not \(2, 2\)"):
            slam6d.ScanModel(np.eye(2))
        model = slam6d.ScanModel(hall_from(self.first, 1, points=100))
        with self.assertRaisesRegex(ValueError, "rigid transform"):
            slam6d.align(model, model, np.ones((4, 4)))
        with self.assertRaisesRegex(slam6d.OptionError, "option icp.metrik: unknown.*'metric'"):
            slam6d.Slam({"icp.metrik": "point-to-plane"})

    def test_poses_may_be_rounded_and_not_absurd(self):
        model = slam6d.ScanModel(hall_from(self.first, 1, points=100))
        slam6d.align(model, model, np.round(pose(0.3, 0.1, 0.7), 4))
        with self.assertRaisesRegex(ValueError, "off by 0.21"):
            slam6d.align(model, model, np.diag([1.1, 1.1, 1.1, 1.0]))
        with self.assertRaisesRegex(ValueError, "within 10000 km"):
            slam6d.Slam().add(hall_from(self.first, 1), pose(1e300, 0.0, 0.0))

    def test_threads_take_turns(self):
        slam = slam6d.Slam()
        clouds = [hall_from(self.first, seed, points=2000) for seed in range(4)]

        def add():
            for cloud in clouds:
                slam.add(cloud, np.eye(4))
                self.assertGreater(len(slam.poses), 0)

        threads = [threading.Thread(target=add) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(slam.poses), 12)

    def test_faults_of_files_are_told(self):
        with tempfile.NamedTemporaryFile("w", suffix=".xyz") as file:
            file.write("1 2 3\n4 5\n")
            file.flush()
            with self.assertWarnsRegex(UserWarning, r":2: expected three .*\(1 of this kind"):
                self.assertEqual(slam6d.read_points(file.name).shape, (1, 3))

    def test_points_of_files(self):
        with tempfile.NamedTemporaryFile("w", suffix=".xyz") as file:
            file.write("1 2 3\n4 5 6\n")
            file.flush()
            np.testing.assert_array_equal(slam6d.read_points(file.name), [[1, 2, 3], [4, 5, 6]])
        with self.assertRaisesRegex(RuntimeError, "nowhere.ply"):
            slam6d.read_points("nowhere.ply")


if __name__ == "__main__":
    unittest.main()
