# student.py: quantiles of Student's t for any number of degrees of freedom, to nine digits.
#
# Formulas: Abramowitz & Stegun, Handbook of Mathematical Functions (1964), named by their numbers there.
import math
from functools import lru_cache
from statistics import NormalDist

EPSILON = 1e-15


@lru_cache(maxsize=None)
def two_sided(confidence, freedom):
    """The t for which a variable of `freedom` > 0 degrees lies between -t and t with probability `confidence`."""
    if not (0 < confidence < 1 and freedom > 0):
        raise ValueError(f"no Student's t of confidence {confidence} with {freedom} degrees of freedom")
    z = NormalDist().inv_cdf((1 + confidence) / 2)
    if freedom > 10000:  # 26.7.5; the next term is below 1e-12
        return (z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)
                + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * freedom**3))
    low, high = z, 2 * z
    while share_beyond(high, freedom) > 1 - confidence:
        low, high = high, 2 * high
    while high - low > 1e-13 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if share_beyond(middle, freedom) > 1 - confidence else (low, middle)
    return (low + high) / 2


def share_beyond(t, freedom):
    """P(|T| > t) of a Student variable (26.7.1)."""
    return incomplete_beta(freedom / (freedom + t * t), t * t / (freedom + t * t), freedom / 2, 0.5)


def incomplete_beta(x, rest, a, b):
    """I_x(a, b), regularised; rest = 1 - x."""
    if x > (a + 1) / (a + b + 2):  # 26.5.2: the fraction of the other side converges fast
        return 1 - incomplete_beta(rest, x, b, a)
    if x <= 0:
        return 0.0
    front = a * math.log(x) + b * math.log(rest) + math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
    return math.exp(front) / a / continued_fraction(x, a, b)


def continued_fraction(x, a, b):
    """1 + d1 / (1 + d2 / (1 + ...)) of 26.5.8, by Lentz's method."""
    value, c, d = 1.0, 1.0, 0.0
    for k in range(1, 10000):
        m = k // 2
        term = x * (m * (b - m) if k % 2 == 0 else -(a + m) * (a + b + m)) / ((a + k - 1) * (a + k))
        d = 1 / (1 + term * d)
        c = 1 + term / c
        value *= c * d
        if abs(c * d - 1) < EPSILON:
            return value
    raise ArithmeticError("the continued fraction of the incomplete beta function does not converge")
