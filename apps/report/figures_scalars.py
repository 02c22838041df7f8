# figures_scalars.py: every number that the vocabulary names against the angle, sectors beside the full vessel.
import math
import textwrap

import numpy as np

from style import FULL, Figure, Image, colour, frame_values, marker, plt, svg
from vocabulary import QUANTITIES, angle_label, quantities, with_unit

COLUMNS = 4


def measured(vessel, moment):
    """Names of the scalars that some ensemble has at a moment: first those of the vocabulary, in its order, then others."""
    found = dict.fromkeys(name for e in vessel.main for run in e.runs for name in run.scalar_names(moment))
    known = [name for name in quantities("scalars") if name in found]
    return known + [name for name in found if name not in QUANTITIES]


def panel(axes, vessel, moment, name):
    """One number: sectors against their angle with the 95 % interval of the mean, the full vessel as a line."""
    sectors = [e for e in vessel.main if not e.full]
    places = {e: k for k, e in enumerate(sectors)}
    shown = []
    for e in sectors:
        sample = e.scalar(moment, name)
        if not sample.n:
            continue
        axes.errorbar([places[e]], [sample.mean], [0 if math.isnan(sample.half) else sample.half], color=colour(e),
                      marker=marker(e), markersize=5, capsize=2.5, linewidth=1.2)
        shown.append([sample.mean])
    if vessel.full is not None:
        sample = vessel.full.scalar(moment, name)
        if sample.n:
            axes.axhline(sample.mean, color=FULL, linewidth=1.2)
            shown.append([sample.mean])
            if math.isfinite(sample.sd):
                axes.axhspan(sample.mean - sample.sd, sample.mean + sample.sd, color="#bdbdbd", alpha=0.5, linewidth=0)
    frame_values(axes, shown)
    axes.set_xlim(-0.5, len(sectors) - 0.5)
    axes.set_xticks(range(len(sectors)))
    axes.set_xticklabels([angle_label(e.order) for e in sectors], fontsize=7, rotation=45)
    axes.set_title(textwrap.fill(with_unit(name), 30), fontsize=7)
    axes.tick_params(axis="y", labelsize=7)


def image(vessel, moment):
    names = [name for name in measured(vessel, moment) if any(e.scalar(moment, name).n for e in vessel.main)]
    if not names or len(vessel.main) < 2:
        return None
    rows = -(-len(names) // COLUMNS)
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(8.4, 1.75 * rows), squeeze=False, constrained_layout=True)
    for k, place in enumerate(np.ravel(axes)):
        if k < len(names):
            panel(place, vessel, moment, names[k])
        else:
            place.axis("off")
    return Image(svg(figure), f"All numbers against the angle, {vessel.when(moment)}: {', '.join(names)}",
                 vessel.brief(moment))


def by_angle(vessel, moments):
    images = [image(vessel, moment) for moment in dict.fromkeys(m for m in moments if m)]
    caption = ("Every number of the analysis. Points: means of sectors over their seeds with the 95 % interval of the mean (none of one "
               "seed); line: full vessel, with one standard deviation over its seeds. Definitions: below.")
    return Figure("All numbers against the angle", images, caption, layout="wide")
