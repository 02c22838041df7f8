# figures_errors.py: tables of `wedge compare --csv`: errors against full vessels beside what full vessels do among themselves.
import math
import os
import re
from html import escape

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap

from ensembles import counted
from read import Table, number
from style import Figure, Image, plt, svg
from tables import minus, shown, table
from vocabulary import quantities, region_label

# What the page shows of a comparison; the files hold the rest.
WANTED = [(kind, q, measure) for kind, table, measure in
          (("scalar", "scalars", "difference"), ("distribution", "distributions", "wasserstein"), ("profile", "profile", "rms"),
           ("map", "map", "rms")) for q in quantities(table, overview=True)]
EDGES = [0, 0.5, 1, 1.5, 2, 3, 5, 1000]
TINTS = ListedColormap(["#eef1f4", "#e2e6ea", "#f6dfae", "#f0b878", "#e48f5c", "#cf5b46", "#96283f"])


class Comparison:
    """A file of `wedge compare --csv`: its rows by moment, region, kind, quantity and measure."""

    def __init__(self, path):
        self.name = os.path.splitext(os.path.basename(path))[0]
        head = re.fullmatch(r"(.+?)_(?:a(\d+(?:\.\d+)?)(?:_(\w+))?|(slot))", self.name)
        self.group = head[1] if head else self.name
        self.angle = float(head[2]) if head and head[2] else math.inf
        self.label = self.name if not head else head[4] or " ".join(filter(None, (f"{head[2]}\u00b0", head[3])))
        columns = Table.read(path).columns
        self.rows = {}
        for k in range(len(columns["moment"]) if columns else 0):
            row = {name: column[k] for name, column in columns.items()}
            self.rows[row["moment"], row["region"], row["kind"], row["quantity"], row["measure"]] = row


def beyond(row):
    return number(row.get("beyond")) == 1


def excess(row):
    """The error over the edge of what full vessels of as many grains show among themselves: above 1 is beyond it."""
    value = row["value"]
    edge = row["yardstick_high"] if value >= 0 or row["measure"] != "difference" else row["yardstick_low"]
    if not (math.isfinite(value) and math.isfinite(edge)):
        return math.nan
    return value / edge if value * edge > 0 else 0.0 if value == 0 else EDGES[-1]


def groups(comparisons):
    for name in dict.fromkeys(c.group for c in comparisons):
        yield name, sorted((c for c in comparisons if c.group == name), key=lambda c: (-c.angle, c.label))


def moments(members):
    """Those with maps where there are any: other moments of the same files tell little that these do not."""
    found = dict.fromkeys(key[0] for c in members for key in c.rows)
    mapped = {key[0] for c in members for key in c.rows if key[2] == "map"}
    return [m for m in found if not mapped or m in mapped]


def figure(name, members):
    images = [image(members, moment) for moment in moments(members)]
    return Figure(f"Errors against the full vessel: {name}", images,
                  "Each number is the error over the edge of the yardstick: what the same measure gives, in 97.5 % of draws, between wedges "
                  "cut from full vessels, as many as there are sectors, and full vessels. Up to 1 (grey) a sector cannot be told from a "
                  "wedge of a full vessel; above (warm) it is beyond. Differences of scalars; Wasserstein distances of distributions; "
                  "weighted root mean square of profiles and maps. Region: all.", layout="wide")


def image(members, moment):
    names = [key for key in WANTED if any((moment, "all") + key in c.rows for c in members)]
    cells = np.full((len(names), len(members)), np.nan)
    for column, c in enumerate(members):
        for line, key in enumerate(names):
            row = c.rows.get((moment, "all") + key)
            cells[line, column] = excess(row) if row else np.nan
    keep = np.isfinite(cells).any(axis=1)
    cells, names = cells[keep], [n for n, k in zip(names, keep) if k]
    if not names:
        return None
    drawing, axes = plt.subplots(figsize=(2.3 + 0.55 * len(members), 0.8 + 0.2 * len(names)), constrained_layout=True)
    axes.imshow(np.ma.masked_invalid(cells), cmap=TINTS, norm=BoundaryNorm(EDGES, TINTS.N, clip=True), aspect="auto")
    for (line, column), ratio in np.ndenumerate(cells):
        if np.isfinite(ratio):
            text = f"{ratio:.1f}" if ratio < 9.95 else f"{ratio:.0f}" if ratio < 999 else "> 999"
            axes.text(column, line, text, ha="center", va="center", fontsize=7.5, color="white" if ratio > 3 else "#222222")
    axes.set_xticks(range(len(members)))
    axes.set_xticklabels([c.label.replace(" ", "\n") for c in members])
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(names)))
    axes.set_yticklabels([f"{q}  ({kind})" for kind, q, _ in names], fontsize=7.5)
    for line in range(1, len(names)):
        if names[line][0] != names[line - 1][0]:
            axes.axhline(line - 0.5, color="#1c1c1c", linewidth=0.8)
    axes.grid(False)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return Image(svg(drawing), f"Errors over the edge of the yardstick, moment {moment}", f"moment {moment}")


def cell(row):
    """Error with its interval, and the yardstick's: in per cent of what `relative` is in parts of, else in the unit."""
    if row is None:
        return "\u2013"
    value, relative = row["value"], row["relative"]
    reference = abs(row["reference"])
    share = relative / value if value and math.isfinite(relative) else 1 / reference if reference and row["measure"] == "difference" else None
    scale, unit = (100 * share, " %") if share and abs(value * share) < 5 else (1.0, "")

    def told(name):
        return minus(shown(float(f"{row[name] * scale:.3g}"))) if math.isfinite(row[name]) else "\u2013"
    text = f"{told('value')}{unit}"
    text = f"<strong>{text}</strong>" if beyond(row) else text
    interval = f" <small>[{told('low')}, {told('high')}]</small>" if math.isfinite(row["low"]) else ""
    yard = f"<br><small class=\"yard\">full: {told('yardstick_low')} to {told('yardstick_high')}</small>" if math.isfinite(row["yardstick_high"]) else ""
    return text + interval + yard


def error_table(name, members):
    rows = []
    for moment in moments(members):
        for region in ("all", "axis_zone"):
            found = [key for key in WANTED if any((moment, region) + key in c.rows for c in members)]
            if found:
                rows.append([f"moment {escape(moment)}, region {escape(region_label(region))}"])
            for key in found:
                entries = [c.rows.get((moment, region) + key) for c in members]
                rows.append([f"<code>{escape(key[1])}</code> <small>{key[0]}, {key[2]}</small>"] + [cell(entry) for entry in entries])
    sizes = [next(iter(c.rows.values()), {}) for c in members]
    head = ["quantity"] + [f"{escape(c.label)}<br><small>{counted(int(s['compared_runs']), 'run')} against {int(s['reference_runs'])}</small>"
                           if s else escape(c.label) for c, s in zip(members, sizes)]
    files = ", ".join(f"<code>{escape(c.name)}.csv</code>" for c in members)
    return table(head, rows, f"From {files}. The error in per cent of its scale (Definitions, <code>relative</code>; else in its unit), bold "
                 "where it is beyond the yardstick; its 95 % interval; below, on screen, the yardstick: wedges of full vessels against full "
                 "vessels.")
