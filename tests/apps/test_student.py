"""test_student.py: Student's t of apps/report against the published table, closed forms and a sum over the density."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "report"))
from student import two_sided  # noqa: E402

# Abramowitz & Stegun, Handbook of Mathematical Functions (1964), table 26.10.
CONFIDENCES = (0.9, 0.95, 0.99, 0.999)
TABLE = {
    1: (6.314, 12.706, 63.657, 636.619),
    2: (2.920, 4.303, 9.925, 31.599),
    3: (2.353, 3.182, 5.841, 12.924),
    5: (2.015, 2.571, 4.032, 6.869),
    10: (1.812, 2.228, 3.169, 4.587),
    16: (1.746, 2.120, 2.921, 4.015),
    30: (1.697, 2.042, 2.750, 3.646),
    120: (1.658, 1.980, 2.617, 3.373),
    math.inf: (1.645, 1.960, 2.576, 3.291),
}


def probability_within(t, freedom):
    """Simpson's rule with t = sqrt(freedom) tan(u), which makes the density cos(u)^(freedom - 1)."""
    def total(end, n=20000):
        h = end / n
        return h / 3 * sum((1 if k in (0, n) else 4 if k % 2 else 2) * math.cos(k * h) ** (freedom - 1) for k in range(n + 1))
    return total(math.atan(t / math.sqrt(freedom))) / total(math.pi / 2)


class Student(unittest.TestCase):
    def test_table(self):
        for freedom, row in TABLE.items():
            for confidence, t in zip(CONFIDENCES, row):
                self.assertAlmostEqual(two_sided(confidence, freedom), t, delta=0.00051, msg=(freedom, confidence))

    def test_closed_forms(self):
        for c in (0.1, 0.5, 0.95, 0.99, 0.9999):
            self.assertAlmostEqual(two_sided(c, 1) / math.tan(math.pi * c / 2), 1, delta=1e-9)
            self.assertAlmostEqual(two_sided(c, 2) / (c * math.sqrt(2 / (1 - c * c))), 1, delta=1e-9)

    def test_broken_degrees_of_freedom(self):
        for freedom in (2.5, 3.7, 11.2, 57.9):
            for c in (0.5, 0.95, 0.99):
                self.assertAlmostEqual(probability_within(two_sided(c, freedom), freedom), c, delta=1e-8, msg=(freedom, c))

    def test_no_step_between_the_two_formulas(self):
        for c in (0.5, 0.95, 0.999):
            self.assertAlmostEqual(two_sided(c, 10000) - two_sided(c, 10001), 0, delta=1e-7)
            self.assertGreater(two_sided(c, 10000), two_sided(c, 10001))

    def test_no_quantile(self):
        for confidence, freedom in ((0, 3), (1, 3), (0.95, 0), (0.95, -1), (0.95, math.nan)):
            with self.assertRaises(ValueError):
                two_sided(confidence, freedom)


if __name__ == "__main__":
    unittest.main()
