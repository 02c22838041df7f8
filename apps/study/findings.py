#!/usr/bin/env python3
"""findings.py COMPARISONS: prints the tables of comparisons in README.md from what compare.sh wrote."""
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
    ("the same outside the axis zone", "flow_mean", "distribution", "cn", "rest", "ks"),
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
    "packing fraction, at rest", "CN of distinct neighbours, at rest", "mean contact force, at rest",
    "mass within d of the axis, at rest", "discharge rate", "CN distribution, flow: KS",
    "the same outside the axis zone", "v_z distribution, flow: KS", "map of v_z, flow: rms")]
SLOT = [row for row in SIDES if row[3] != "discharge_rate"]  # that of a slot is of another opening
VESSELS = (
    ("hopper20", "Hopper, D = 20 d", HOPPER),
    ("hopper40", "Hopper, D = 40 d", HOPPER),
    ("pile", "Sandpile", PILE))
ANGLES = (90, 60, 45, 30)
BOUNDS = ("images", "pin", "line", "frictionless", "rigid")


def rows_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return {tuple(row[k] for k in ("moment", "kind", "quantity", "region", "measure")): row
                for row in csv.DictReader(text)}


def number(text):
    value = float(text)
    return f"{value:.0f}" if abs(value) >= 99.95 else f"{value:.1f}"


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
        low = max(low, -100)  # scalars here are never negative
    known = math.isfinite(low) and math.isfinite(high)
    text = f"{number(value)} [{number(low)}, {number(high)}]" if known else number(value)
    return f"**{text}**" if row["beyond"] == "1" else text


def arched(rows):
    row = rows.get(("flow_mean", "scalar", "arched", "all", "difference"))
    if row is None:
        return "-"
    runs = int(row["compared_runs"])
    return f"{float(row['compared']) * runs:.0f} of {runs}"


def print_row(heading, cells):
    if set(cells) != {"-"}:
        print(f"| {heading} | " + " | ".join(cells) + " |")


def print_table(folder, columns, quantities):
    """A table of the comparisons, (heading, name of the file), that there are."""
    files = {heading: folder / f"{name}.csv" for heading, name in columns}
    tables = {heading: rows_of(file) for heading, file in files.items() if file.exists()}
    if not tables:
        return
    print("| [%] | " + " | ".join(tables) + " |\n|---" + "|---" * len(tables) + "|")
    for heading, *row in quantities:
        print_row(heading, [cell(rows.get(tuple(row))) for rows in tables.values()])
    print_row("arched", [arched(rows) for rows in tables.values()])
    print()


def main(comparisons):
    folder = pathlib.Path(comparisons)
    for name, title, quantities in VESSELS:
        print(f"**{title}**\n")
        print_table(folder, [(f"{angle}°", f"{name}_a{angle}") for angle in ANGLES], quantities)
    print("**What bounds a sector** (hopper, D = 20 d)\n")
    for angle in (90, 45):
        print_table(folder, [(f"{angle}°, clamp", f"hopper20_a{angle}")] + [
            (f"{angle}°, {bound}", f"sides_a{angle}_{bound}") for bound in BOUNDS], SIDES)
    print_table(folder, [("slot", "sides_slot")], SLOT)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python3 apps/study/findings.py COMPARISONS")
    main(sys.argv[1])
