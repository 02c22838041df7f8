#!/usr/bin/env python3
"""rule.py [RUNS]: how wrong a sector is against its angle, from the runs of the set `angle` (and hopper20, hopper40, pile) kept in
RUNS (runs/ beside this file): a table, and for each quantity which of these rules the data support:

    core   error = a (d / (D theta))^2          what is wrong fills a core of an arc of some d: its share of the cross section
    seam   error = a d / (D theta)              what is wrong grows with the length of the axis over that of the arc
    flow   error = a (d / (D0 theta))^2         it is the core over the orifice that counts, whatever the vessel
    flow4  error = a (d / (D0 theta))^4         the same, but of no weight until the flow is near to stopping

Errors are relative to the mean of the full vessels; chi2 per degree of freedom says how far a rule is from the data, in standard errors.

At rest, vessels of the same seed that differ by the orifice alone hold the same bed: those with an orifice of 8 d count. Flows are
of runs that neither arched nor were interrupted (for 0.1 s less than a quarter of their mean rate), and their rules, as that of
arches, of sectors whose arc at the rim of the orifice is at least 2 d (theta D0 / d >= 4): below, a column of grains on the axis is
all that can fall. The spread of runs is c / sqrt(N), N the grains of the domain (of rates and speeds: those that fit into its share
of the orifice), c pooled over all ensembles; an ensemble's own spread is drawn towards it as if it were known from PRIOR more runs.
Stops: logistic regression of the share of sectors that arched or were interrupted on theta (D0 / d - k), k that of the greatest
likelihood. Needs numpy (Debian: python3-numpy)."""
import collections
import csv
import math
import pathlib
import re
import sys

try:
    import numpy as np
except ImportError:
    sys.exit("error: rule.py needs numpy: apt-get install python3-numpy, and run it with /usr/bin/python3")

RUNS = pathlib.Path(__file__).parent / "runs"
ANGLES = [180, 120, 90, 72, 60, 45, 36, 30, 24, 20, 15]  # degrees
QUANTITIES = [  # name, moment, short meaning
    ("packing", "settle", "packing fraction at rest"),
    ("cn", "settle", "CN at rest"),
    ("cn_distinct", "settle", "CN of distinct neighbours at rest"),
    ("load", "settle", "mean contact force at rest"),
    ("packing", "flow_mean", "packing fraction in flow"),
    ("cn", "flow_mean", "CN in flow"),
    ("cn_distinct", "flow_mean", "CN of distinct neighbours in flow"),
    ("speed", "flow_mean", "root mean square speed in flow"),
    ("discharge_rate", "flow_mean", "discharge rate"),
]
OF_THE_ORIFICE = ("speed", "discharge_rate")  # quantities that vary with what is over the orifice
SHAPES = {
    "core": lambda w, o, t: 1 / (w * t) ** 2,
    "seam": lambda w, o, t: 1 / (w * t),
    "flow": lambda w, o, t: 1 / (o * t) ** 2,
    "flow4": lambda w, o, t: 1 / (o * t) ** 4,
}
LEAST_RIM = 4      # theta D0 / d
ONE_ORIFICE = 8    # d, of the beds at rest that count
PRIOR = 4          # degrees of freedom
FLOW_BEGINS = 0.7  # s after the opening
Row = collections.namedtuple("Row", "vessel width orifice theta error of_sectors of_full sectors")
RUN = re.compile(r"w(\d+)_o(\d+)_a(\d+)_s(\d+)$")


def runs_in(folder):
    """(set, D/d, D0/d, angle [deg]) of every run of these sets, and its numbers: {(moment, quantity): value}, those of wedges cut
    from it under {(moment, quantity, angle): [values]}."""
    for path in sorted(pathlib.Path(folder).glob("*/*/results/scalars.csv")):
        set_name, name = path.parts[-4], path.parts[-3]
        if set_name == "angle":
            found = RUN.match(name)
            if not found:
                continue
            width, orifice, angle = (int(found.group(k)) for k in (1, 2, 3))
        elif set_name in ("hopper20", "hopper40"):
            width, orifice, angle = int(set_name[6:]), 8, int(re.match(r"a(\d+)_", name).group(1))
        elif set_name == "pile":
            width, orifice, angle = 40, 0, int(re.match(r"a(\d+)_", name).group(1))
        else:
            continue
        numbers = {}
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                moment, quantity, value = row["moment"], row["quantity"], float(row["value"])
                if row["part"] == "whole":
                    numbers[moment, quantity] = value
                else:  # wedge_ANGLE_NUMBER
                    numbers.setdefault((moment, quantity, int(row["part"].split("_")[1])), []).append(value)
        flow = path.with_name("flow.csv")
        if flow.exists():
            numbers["flow_mean", "interrupted"] = float(interrupted(*read_flow(flow)))
        yield (set_name, width, orifice, angle), numbers


def read_flow(path):
    """Times after the opening [s] and grains out until then, from where the average over the flow begins."""
    with open(path, newline="") as file:
        rows = [(float(row["time [s]"]), float(row["out"])) for row in csv.DictReader(file)]
    return np.array([row for row in rows if row[0] > FLOW_BEGINS - 1e-6]).T


def interrupted(time, out):
    """Whether for some 0.1 s (two rows of flow.csv) fewer grains came than a quarter of what the mean rate would bring."""
    mean = (out[-1] - out[0]) / (time[-1] - time[0])
    return bool((out[2:] - out[:-2] < 0.25 * mean * (time[2:] - time[:-2])).any())


def stopped(run):
    """1 where a flow arched or was interrupted, 0 where not, nan where nothing could flow."""
    arched = run.get(("flow_mean", "arched"), math.nan)
    return max(arched, run.get(("flow_mean", "interrupted"), 0)) if math.isfinite(arched) else math.nan


def size_of(key, runs, quantity):
    """What the spread of a quantity goes down with, by its root: grains of the domain, or over its orifice."""
    _, _, orifice, angle = key
    if quantity in OF_THE_ORIFICE:
        return orifice**2 * angle / 360
    return np.mean([r["settle", "grains"] for r in runs]) * angle / 360


def values_of(key, runs, quantity, moment):
    """Values of the runs of an ensemble; of a flow those that are steady, at rest those of one orifice of each vessel."""
    if moment == "settle" and key[2] not in (0, ONE_ORIFICE):
        return []
    values = [r.get((moment, quantity), math.nan) for r in runs if not (moment == "flow_mean" and stopped(r) == 1)]
    return [v for v in values if math.isfinite(v)]


def relative_spread(values):
    return np.std(values, ddof=1) / abs(np.mean(values)) if len(values) > 1 else 0.0


def errors_of(ensembles, quantity, moment):
    """Rows: vessel (set, D/d, D0/d), D/d, D0/d, theta [rad], error relative to the full vessel, standard errors of the sectors and of
    the full vessels, how many sectors. And c of the spread."""
    values = {key: values_of(key, runs, quantity, moment) for key, runs in ensembles.items()}
    values = {key: v for key, v in values.items() if v}
    freedom = sum(len(v) - 1 for v in values.values())
    if freedom == 0:
        return [], math.nan
    sizes = {key: size_of(key, ensembles[key], quantity) for key in values}
    c2 = sum(relative_spread(v) ** 2 * sizes[key] * (len(v) - 1) for key, v in values.items()) / freedom

    def standard_error(key):
        v = values[key]
        spread2 = ((len(v) - 1) * relative_spread(v) ** 2 + PRIOR * c2 / sizes[key]) / (len(v) - 1 + PRIOR)
        return math.sqrt(spread2 / len(v))

    rows = []
    for key in sorted(values):
        name, width, orifice, angle = key
        full = (name, width, orifice, 360)
        if key == full or full not in values:
            continue
        error = np.mean(values[key]) / np.mean(values[full]) - 1
        rows.append(Row((name, width, orifice), width, orifice, math.radians(angle), error, standard_error(key),
                        standard_error(full), len(values[key])))
    return rows, math.sqrt(c2)


def ruled(rows, moment):
    """The rows that the rules are of."""
    return [r for r in rows if moment != "flow_mean" or r.orifice * r.theta >= LEAST_RIM]


def fit(rows, shape):
    """Factor a with its error, and chi2 per degree of freedom, of error = a shape(D/d, D0/d, theta), by generalised least
    squares: sectors that are compared with the same full vessels share the error of these. An error is never less than
    the scatter about the rule says."""
    x = np.array([shape(r.width, r.orifice, r.theta) for r in rows])
    y = np.array([r.error for r in rows])
    shared = np.array([[a.of_full * b.of_full if a.vessel == b.vessel else 0 for b in rows] for a in rows])
    weights = np.linalg.inv(shared + np.diag([r.of_sectors**2 for r in rows]))
    weight = x @ weights @ x
    a = x @ weights @ y / weight
    chi2 = (y - a * x) @ weights @ (y - a * x) / max(1, len(rows) - 1)
    return a, math.sqrt(max(1, chi2) / weight), chi2


def logistic(x, y):
    """Maximum likelihood of p = 1 / (1 + exp((x - middle) / width)) by a search; returns middle, its standard error (from the
    profile of the likelihood: half of where -2 log L is within 3.84 of the least, over 1.96), width, -2 log L."""
    middles, widths = np.linspace(0.5, 14, 271), np.geomspace(0.05, 4, 80)
    loss = np.empty((len(middles), len(widths)))
    for i, middle in enumerate(middles):
        p = np.clip(1 / (1 + np.exp(np.clip((x - middle) / widths[:, None], -50, 50))), 1e-9, 1 - 1e-9)
        loss[i] = -2 * np.log(np.where(y > 0, p, 1 - p)).sum(axis=1)
    i, k = np.unravel_index(loss.argmin(), loss.shape)
    near = middles[loss.min(axis=1) < loss.min() + 3.84]
    return middles[i], (near.max() - near.min()) / 2 / 1.96, widths[k], loss.min()


def best_rim(theta, orifice, stops):
    """k of theta (D0 / d - k) for which the stops are likeliest, the range of k within 95 %, and the fits by k."""
    fits = {k: logistic(theta * (orifice - k), stops) for k in np.arange(0, 6.25, 0.25)}
    best = min(fits, key=lambda k: fits[k][-1])
    near = [k for k in fits if fits[k][-1] < fits[best][-1] + 3.84]
    return best, (min(near), max(near)), fits


def in_per_cent(row):
    return f"{100 * row.error:+.1f} ± {100 * math.hypot(row.of_sectors, row.of_full):.1f}"


def print_errors(ensembles):
    for quantity, moment, meaning in QUANTITIES:
        rows, c = errors_of(ensembles, quantity, moment)
        counted = ruled(rows, moment)
        if len(counted) < 3:
            continue
        over = "orifice" if quantity in OF_THE_ORIFICE else "domain"
        print(f"\n### {meaning} (`{quantity}`, {moment})\n")
        print(f"{len(counted)} ensembles, {sum(r.sectors for r in counted)} sectors; spread of runs {c:.2g} / sqrt(grains of the {over})\n")
        print("| rule | a | chi2 / dof |\n|---|---|---|")
        for name, shape in SHAPES.items():
            a, error, chi2 = fit(counted, shape)
            print(f"| {name} | {a:.3g} ± {error:.2g} | {chi2:.2f} |")
        print("\n| vessel | " + " | ".join(f"{a}°" for a in ANGLES) + " |\n|---" + "|---" * len(ANGLES) + "|")
        for vessel in sorted({r.vessel for r in rows}):
            here = {round(math.degrees(r.theta)): in_per_cent(r) for r in rows if r.vessel == vessel}
            print(f"| D {vessel[1]} d, orifice {vessel[2]} d ({vessel[0]}) | " + " | ".join(here.get(a, "") for a in ANGLES) + " |")


def print_stops(ensembles):
    theta, holes, stops, rows = [], [], [], {}
    for (name, width, orifice, angle), runs in ensembles.items():
        arched = [r["flow_mean", "arched"] for r in runs if math.isfinite(stopped(r))]
        stopping = [stopped(r) for r in runs if math.isfinite(stopped(r))]
        if not stopping:
            continue
        paused = sum(stopping) - sum(arched)
        rows.setdefault((name, width, orifice), {})[angle] = f"{sum(arched):.0f}" + (f" + {paused:.0f}" if paused else "") + f" of {len(arched)}"
        if angle != 360 and math.radians(angle) * orifice >= LEAST_RIM:
            theta += [math.radians(angle)] * len(stopping)
            holes += [orifice] * len(stopping)
            stops += stopping
    print("\n### stops: arched (+ interrupted) of all\n")
    print("| vessel | full | " + " | ".join(f"{a}°" for a in ANGLES) + " |\n|---|---" + "|---" * len(ANGLES) + "|")
    for vessel, by_angle in sorted(rows.items()):
        print(f"| D {vessel[1]} d, orifice {vessel[2]} d ({vessel[0]}) | " + " | ".join(by_angle.get(a, "") for a in [360] + ANGLES) + " |")
    best, (low, high), fits = best_rim(np.array(theta), np.array(holes), np.array(stops))
    middle, error, width, loss = fits[best]
    print(f"\nHalf of the sectors stop at x = theta (D0 / d - {best:g}) = {middle:.2f} ± {error:.2f}; share 1 / (1 + exp((x - {middle:.2f}) / {width:.2f}));"
          f" -2 log L = {loss:.1f} over {len(stops)} runs (with D0 / d alone {fits[0][-1]:.1f}; {low:g} to {high:g} in place of {best:g} are within 95 %)")


def print_pile(ensembles):
    """Of a pile on a plate of 32 d, and how much of its angle of repose is the fit to a flank of so few grains."""
    for quantity, meaning, power in (("angle_of_repose", "angle of repose", 1), ("cn_distinct", "CN of distinct neighbours of a pile", 2)):
        rows, _ = errors_of(ensembles, quantity, "pile")
        if not rows:
            continue
        a, error, chi2 = fit(rows, lambda w, o, t: t**-power)
        print(f"\n### {meaning} (`{quantity}`, pile; plate of 32 d)\n")
        print("; ".join(f"{math.degrees(r.theta):.0f}° {in_per_cent(r)}" for r in sorted(rows, key=lambda r: -r.theta)))
        print(f"\nerror = a / theta{'' if power == 1 else '^2'}: a = {a:.3g} ± {error:.2g}, chi2 / dof {chi2:.2f}")
    cut = {}
    for (_, _, _, angle), runs in ensembles.items():
        for run in runs if angle == 360 else []:
            for of in ANGLES:
                whole = run.get(("pile", "angle_of_repose"), math.nan)
                cut.setdefault(of, []).extend(100 * (v / whole - 1) for v in run.get(("pile", "angle_of_repose", of), []))
    print("\nAngle of repose of wedges cut from full piles, against these: " + "; ".join(
        f"{of}° {np.mean(v):+.1f} ± {np.std(v, ddof=1) / math.sqrt(len(v)):.1f}" for of, v in cut.items() if len(v) > 1))


def main(folder):
    ensembles, piles = {}, {}
    for key, numbers in runs_in(folder):
        (piles if key[0] == "pile" else ensembles).setdefault(key, []).append(numbers)
    print_errors(ensembles)
    print_stops(ensembles)
    print_pile(piles)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else RUNS)
