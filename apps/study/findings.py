#!/usr/bin/env python3
"""findings.py COMPARISONS: the tables of README.md, "The paper, measured", from what compare.sh wrote: sectors against the full
vessel. A cell is the difference in per cent of the full vessel (or the distance in per cent of its scale) with its 95 % interval;
in bold where it is beyond the full vessel's own spread at as many grains. Scalars here are never negative, so no interval of their
differences reaches below -100 %."""
import csv
import math
import pathlib
import sys

HOPPER = [  # heading, moment, kind, quantity, region, measure
    ("packing fraction, at rest", "settle", "scalar", "packing", "all", "difference"),
    ("CN, at rest", "settle", "scalar", "cn", "all", "difference"),
    ("CN of distinct neighbours, at rest", "settle", "scalar", "cn_distinct", "all", "difference"),
    ("mean contact force, at rest", "settle", "scalar", "load", "all", "difference"),
    ("mass within d of the axis, at rest", "settle", "scalar", "axis_mass_1d", "all", "difference"),
    ("packing fraction, flow", "flow_mean", "scalar", "packing", "all", "difference"),
    ("mean contact force, flow", "flow_mean", "scalar", "load", "all", "difference"),
    ("discharge rate", "flow_mean", "scalar", "discharge_rate", "all", "difference"),
    ("CN distribution, 0.7 s: KS", "open", "distribution", "cn", "all", "ks"),
    ("CN distribution, flow: KS", "flow_mean", "distribution", "cn", "all", "ks"),
    ("the same outside the core", "flow_mean", "distribution", "cn", "rest", "ks"),
    ("v_r distribution, flow: KS", "flow_mean", "distribution", "vr", "all", "ks"),
    ("v_t distribution, flow: KS", "flow_mean", "distribution", "vt", "all", "ks"),
    ("v_z distribution, flow: KS", "flow_mean", "distribution", "vz", "all", "ks"),
    ("f_r distribution, flow: KS", "flow_mean", "distribution", "fr", "all", "ks"),
    ("f_t distribution, flow: KS", "flow_mean", "distribution", "ft", "all", "ks"),
    ("f_z distribution, flow: KS", "flow_mean", "distribution", "fz", "all", "ks"),
    ("map of v_z, flow: rms", "flow_mean", "map", "vz", "all", "rms"),
]
PILE = [
    ("grains left", "pile", "scalar", "grains", "all", "difference"),
    ("angle of repose", "pile", "scalar", "angle_of_repose", "all", "difference"),
    ("CN, pile", "pile", "scalar", "cn", "all", "difference"),
    ("CN of distinct neighbours, pile", "pile", "scalar", "cn_distinct", "all", "difference"),
    ("CN distribution, 0.14 s: KS", "collapse", "distribution", "cn", "all", "ks"),
    ("v_r distribution, 0.14 s: KS", "collapse", "distribution", "vr", "all", "ks"),
    ("v_z distribution, 0.14 s: KS", "collapse", "distribution", "vz", "all", "ks"),
    ("f_z distribution, 0.14 s: KS", "collapse", "distribution", "fz", "all", "ks"),
    ("map of v_z, 0.14 s: rms", "collapse", "map", "vz", "all", "rms"),
]
SIDES = [row for row in HOPPER if row[0] in (
    "packing fraction, at rest", "CN of distinct neighbours, at rest", "mean contact force, at rest", "mass within d of the axis, at rest",
    "discharge rate", "CN distribution, flow: KS", "the same outside the core", "v_z distribution, flow: KS", "map of v_z, flow: rms")]
SLOT = [row for row in SIDES if row[3] != "discharge_rate"]  # that of a slot, by its own opening, is another quantity


def rows_of(file):
    with open(file, newline="") as text:
        return {tuple(r[k] for k in ("moment", "kind", "quantity", "region", "measure")): r for r in csv.DictReader(text)}


def number(text):
    value = float(text)
    if abs(value) >= 99.95:
        return f"{value:.0f}"
    return f"{value:.1f}"


def scale_of(row):
    """Per cent in one unit of the row: of what `relative` is in parts of. None where it is not known."""
    value, relative, reference = (float(row[k]) for k in ("value", "relative", "reference"))
    if row["measure"] == "difference":
        return 100 / abs(reference) if reference != 0 else None
    if row["measure"] == "ks":
        return 100
    return 100 * relative / value if value != 0 else None


def cell(row):
    """Value and interval in per cent; of a value without an interval the value."""
    scale = None if row is None or row["value"] in ("", "nan") else scale_of(row)
    if scale is None:
        return "-"
    value, low, high = (scale * float(row[k]) for k in ("value", "low", "high"))
    if row["measure"] == "difference":
        low = max(low, -100)
    text = f"{number(value)} [{number(low)}, {number(high)}]" if math.isfinite(low) and math.isfinite(high) else number(value)
    return f"**{text}**" if row["beyond"] == "1" else text


def table(folder, columns, quantities):
    tables = {heading: rows_of(folder / (name + ".csv")) for heading, name in columns if (folder / (name + ".csv")).exists()}
    if not tables:
        return
    print("| [%] | " + " | ".join(tables) + " |\n|---" + "|---" * len(tables) + "|")
    for heading, moment, kind, quantity, region, measure in quantities:
        cells = [cell(rows.get((moment, kind, quantity, region, measure))) for rows in tables.values()]
        if set(cells) != {"-"}:
            print(f"| {heading} | " + " | ".join(cells) + " |")
    arched = [rows.get(("flow_mean", "scalar", "arched", "all", "difference")) for rows in tables.values()]
    if any(arched):
        print("| arched | " + " | ".join(
            f"{float(r['compared']) * int(r['compared_runs']):.0f} of {r['compared_runs']}" if r else "-" for r in arched) + " |")
    print()


def main(comparisons):
    folder = pathlib.Path(comparisons)
    angles = (90, 60, 45, 30)
    for name, title, quantities in (("hopper20", "Hopper, D = 20 d", HOPPER), ("hopper40", "Hopper, D = 40 d", HOPPER),
                                    ("pile", "Sandpile", PILE)):
        print(f"**{title}**\n")
        table(folder, [(f"{a}°", f"{name}_a{a}") for a in angles], quantities)
    print("**What bounds a sector** (hopper, D = 20 d)\n")
    for angle in (90, 45):
        table(folder, [(f"{angle}°, clamp", f"hopper20_a{angle}")] + [
            (f"{angle}°, {bound}", f"sides_a{angle}_{bound}") for bound in ("images", "pin", "line", "frictionless", "rigid")], SIDES)
    table(folder, [("slot", "sides_slot")], SLOT)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python3 apps/study/findings.py COMPARISONS")
    main(sys.argv[1])
