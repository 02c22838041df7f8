# page.py [--quick] RESULTS BASE ORIGIN: BASE.md, the tables of speed and error with their uncertainties, and BASE.svg, from the
# files in the folder RESULTS; ORIGIN says where they come from. speed_error.sh calls it.
import argparse
import math
import pathlib
import re

import figure
from results import Results, Sample, difference, is_significant, trend

BY_HAND = "<!-- by hand from here on: speed_error.sh keeps it -->"
RESTING = 1e-6  # m g d; wedge's own criterion is 5e-7, the mean of 0.5 m (1e-3 sqrt(g d))^2
TREND_UP_TO = 20  # % of the Rayleigh time

QUANTITIES = {"packing": "packing fraction", "coordination": "coordination number", "overlap": "mean overlap / d",
              "stress": "vertical stress"}
QUANTITIES_OF = {"hopper": {"floor": "load on the floor / weight", "rate": "discharge rate [1/s]"},
                 "pile": {"left": "grains left", "angle": "angle of repose [deg]"}}

# Title, what is varied, order of the rows: the first is the reference.
TABLES = (
    ("Time step", ["step"], lambda v: v.step),
    ("Stiffness", ["young"], lambda v: -v.young),
    ("Skin", ["skin"], lambda v: v.skin),
    ("Angle of a sector", ["angle", "axis"], lambda v: (v.angle != 360, v.axis, -v.angle)),
    ("Precision", ["precision"], lambda v: (v.precision != "double", v.precision)),
)

INTRODUCTION = """# Speed against error

How much accuracy does speed cost, in the time step, the stiffness, the skin, the precision and the angle of a sector?

Made by `{command}`
({origin})
from two scenes:

{scenes}Every table holds the standard choice: a step of {standard.step:g} % of the Rayleigh time, E = {young} Pa, the skin
that wedge chooses, {standard.precision} precision, the full vessel. The number of seeds (1, 2, ...) stands above each table.

**Cells** are differences from the mean of the reference in per cent of it, ± their standard errors, from the spread of
both over the seeds. **Bold**: beyond the 99 % interval of Welch's comparison of two means. A plain number is within the
spread: no error was seen, which does not prove that there is none. The row of the reference has means ± standard
errors. *Smallest error that would show*: half the width of that interval for the standard choice, or for the last row
where the standard choice is the reference.

**Speed** is simulated time per second of processor time, relative to the standard choice, with the bed settled and with
the outlet open. All variants take turns within one process: median (least to most) of the rounds. `steps`: the ratio of
simulated time per step.

**Vertical stress**: the sum over contacts of vertical force times vertical branch, over the sum of weight times height
of all grains, to which it would be equal without walls. **Heat**: the mean kinetic energy of a grain after settling, in
m g d, the largest of the seeds. **At rest**: by wedge's own criterion, within 1 s. **Residual**: what the energy budget
leaves unexplained at the end, in per cent of what was dissipated; `wedge run` warns beyond 10 % and stops beyond 50 %,
these runs go on. A hopper has **arched** when no grain came for 0.25 s before {discharged} (counted for the whole
vessel) were out; the rate, between 10 and 90 % of these, is that of the others.

![error against speed]({picture})
"""

IMPACTS = """
## Impacts

A grain hits a resting one at 10, 25, 40, 55 and 70 degrees off the line of centres, with the first touch at {places}
places within a step. The tables have the root mean square error of the restitution and of the final spin, in per cent
of their own root mean square, ± its uncertainty by these places, against runs at 0.05 % of the Rayleigh time. The first
row bounds the error left in that reference.
"""

STABILITY = """
## Stability of a bed at rest

A bed (seed 1) that came to rest at the standard step (with a damping ratio of 0.6: at 5 %) goes on at another one for
1000 Rayleigh times. The table has the mean kinetic energy of a grain in m g d; "rests": below 1e-6; "stopped": by a
guard against overlap. Soft grains stand for deep beds too, whose overlaps are as large.

"""

DRIFT = """
## Drift of trajectories

Root mean square distance of equal grains, in d, from one moment of the flow on: mean of the seeds ± standard error. The
first line of a scene is what chaos makes of round-off alone.

"""


def row(cells):
    return "| " + " | ".join(cells) + " |\n"


def head(cells):
    return row(cells) + row(["---"] * len(cells))


def short_power(value):
    """1e+07 as 1e7."""
    return re.sub(r"e\+?(-?)0?", r"e\1", f"{value:.0e}") if math.isfinite(value) else str(value)


def in_percent(d):
    return f"{100 * d.value:+.2g} ± {100 * d.standard_error:.2g}"


class Page:
    def __init__(self, results, quick):
        self.results, self.quick = results, quick
        self.comparisons = self.significant = 0

    def text(self, origin, picture):
        body = self.impacts()
        for title, varied, order in TABLES:
            variants = sorted(self.results.variants(varied), key=order)
            if len(variants) < 2:
                continue
            body += f"\n## {title}\n"
            for scene in self.results.scenes:
                body += self.errors(title, varied, variants, scene)
        body += STABILITY + self.stability() + DRIFT + self.drift()
        return (self.introduction(origin, picture) + body + f"\nOf the {self.comparisons} comparisons with a reference above, "
                f"{self.significant} are bold; {0.01 * self.comparisons:.1f} would be by chance alone.\n")

    def introduction(self, origin, picture):
        setup, scenes = self.results.setup, ""
        for scene in self.results.scenes:
            changes = "".join(f"      --set '{change}'\n" for change in setup[scene, "set"])
            scenes += f"- **{scene}**: `{setup[scene, 'file'][0]}` with\n\n{changes}\n"
        return INTRODUCTION.format(
            command="bash perf/speed_error/speed_error.sh" + (" --quick" if self.quick else ""), origin=origin, scenes=scenes,
            standard=self.results.standard, young=short_power(self.results.standard.young), picture=picture,
            discharged=setup["", "discharged"][0])

    def impacts(self):
        text = IMPACTS.format(places=self.results.setup["", "impact_places"][0])
        for scene in self.results.scenes:
            found = self.results.of("impact", scene)
            speeds = sorted({float(speed) for _, _, speed, _ in found})
            text += f"\n{scene}:\n\n" + head(
                ["step, % of Rayleigh", "steps in a contact, " + " and ".join(f"{s:g}" for s in speeds) + " m/s"]
                + [f"{key}, {s:g} m/s" for key in ("restitution", "spin") for s in speeds])
            for step in sorted({v.step for v, _, _, _ in found}):
                at = {float(speed): numbers for (v, _, speed, _), numbers in found.items() if v.step == step}
                if len(at) < len(speeds):
                    continue
                text += row([f"{step:g}", ", ".join(f"{at[s]['contact_steps']:.0f}" for s in speeds)]
                            + [f"{100 * at[s][key]:.2g} ± {100 * at[s][key + '_error']:.1g}"
                               for key in ("restitution", "spin") for s in speeds])
        return text

    def errors(self, title, varied, variants, scene):
        quantities = {**QUANTITIES, **QUANTITIES_OF[scene]}
        reference, standard = variants[0], self.results.standard
        counts = [len(self.results.beds(scene, v)) for v in variants]
        seeds = (f"{min(counts)} to " if min(counts) < max(counts) else "") + f"{max(counts)} seed{'s' if max(counts) != 1 else ''}"
        text = f"\n{scene}, {seeds}, reference {self.label(varied, reference)}:\n\n" + head(
            [title, "steps", "speed, settled", "speed, open", *quantities.values(), "heat (largest)", "at rest", "residual, %",
             "stopped by a guard", "arched" if scene == "hopper" else "pile at rest"])
        for v in variants:
            name = self.label(varied, v) + (", reference" if v == reference else "")
            cells = [name, f"{v.step / standard.step * math.sqrt(standard.young / v.young):.3g}",
                     self.speed(scene, v, "rest"), self.speed(scene, v, "flow")]
            for key in quantities:
                mine, base = (self.results.sample(scene, w, key) for w in (v, reference))
                cells.append(self.mean(base, ".4g", ".2g") if v == reference else self.cell(mine, base))
            text += row(cells + self.plain_cells(scene, v))
        shown, last = [], variants[-1] if reference == standard else standard
        for key in quantities:
            d = difference(self.results.sample(scene, last, key), self.results.sample(scene, reference, key))
            shown.append(f"{100 * d.bound:.3g}" if d else "-")
        text += row(["*smallest error that would show*, %", "", "", "", *shown] + [""] * 5)
        return text + (self.trend_row(variants, scene, quantities) if varied == ["step"] else "")

    def label(self, varied, v):
        return {"step": f"{v.step:g} %", "young": short_power(v.young) + " Pa",
                "skin": f"{v.skin:g} d" if v.skin > 0 else "wedge's own", "precision": v.precision,
                "angle": "360, full" if v.angle == 360 else f"{v.angle:g}, {v.axis}"}[varied[0]]

    def speed(self, scene, v, phase):
        for (variant, _, _, _), found in self.results.of("race", scene).items():
            if variant == v:
                return "{:.2f} ({:.2f} to {:.2f})".format(*(found[f"speed_{phase}{end}"] for end in ("", "_low", "_high")))
        return "-"

    def mean(self, sample, digits, error_digits):
        if sample.count == 0:
            return "-"
        error = f"± {sample.standard_error:{error_digits}}" if sample.count > 1 else "(one seed)"
        return f"{sample.mean:{digits}} {error}"

    def cell(self, sample, reference):
        d = difference(sample, reference)
        if d is None:
            one = sample.count and reference.count and reference.mean
            return f"{100 * (sample.mean / reference.mean - 1):+.2g} (one seed)" if one else "-"
        self.comparisons += 1
        self.significant += is_significant(d)
        return f"**{in_percent(d)}**" if is_significant(d) else in_percent(d)

    def plain_cells(self, scene, v):
        """Heat, rest, residual, guards, arches: numbers that are not errors."""
        def of(quantity):
            return self.results.sample(scene, v, quantity)

        def share(quantity):
            return f"{of(quantity).values.sum():.0f} of {of(quantity).count}"

        residual = of("residual_end")
        return [short_power(max(of("heat").values, default=0)), share("bed_rests"),
                f"{100 * residual.mean:.3g}" if residual.count else "-", share("broke"),
                share("arched" if scene == "hopper" else "pile_rests")]

    def trend_row(self, variants, scene, quantities):
        cells = [f"*trend*: change per 10 % more step, steps up to {TREND_UP_TO} %", "", "", ""]
        for key in quantities:
            points = [(v.step, value) for v in variants if v.step <= TREND_UP_TO
                      for value in self.results.sample(scene, v, key).values]
            d = trend(*zip(*points)) if points else None
            if d is None:
                cells.append("-")
                continue
            ten = type(d)(*(10 * number for number in d))
            cells.append(f"**{in_percent(ten)}**" if is_significant(ten) else in_percent(ten))
        return row(cells + [""] * 5)

    def stability(self):
        beds = [(scene, float(damping), v.young, found) for scene in self.results.scenes
                for (v, damping, _, _), found in self.results.of("stability", scene).items()]
        steps = sorted({int(key[4:]) for *_, found in beds for key in found if re.fullmatch(r"heat\d+", key)})
        text = head(["scene", "E [Pa]", "damping", "mean overlap / d"] + [f"{step} %" for step in steps])
        for scene, damping, young, found in sorted(beds, key=lambda bed: bed[:3]):
            heats = [found[f"heat{step}"] for step in steps]
            text += row([scene, short_power(young), f"{damping:g}", f"{found['overlap']:.2g}"]
                        + ["rests" if heat < RESTING else f"**{short_power(heat)}**" if math.isfinite(heat) else "**stopped**"
                           for heat in heats])
        return text

    def drift(self):
        text = head(["scene", "against double precision", "after 10 steps", "after 100", "after 1000"])
        for scene in self.results.scenes:
            found = self.results.of("drift", scene)
            for other in sorted({v.precision for v, _, _, _ in found}, key=lambda name: (name != "nudged", name)):
                cells = [scene, "double, places moved by their last bit" if other == "nudged" else other]
                for after in ("after10", "after100", "after1000"):
                    of_seeds = [numbers for (v, _, _, _), numbers in found.items() if v.precision == other]
                    largest = max(numbers[after + "_largest"] for numbers in of_seeds)
                    rms = Sample([numbers[after] for numbers in of_seeds])
                    cells.append(f"{self.mean(rms, '.1e', '.0e')}, largest {largest:.1e}")
                text += row(cells)
        return text


def main():
    parser = argparse.ArgumentParser(description="Writes the page and the figure of speed against error.")
    parser.add_argument("--quick", action="store_true")
    for name in ("results", "base", "origin"):
        parser.add_argument(name)
    options = parser.parse_args()
    results = Results(options.results)
    path, picture = (pathlib.Path(options.base + end) for end in (".md", ".svg"))
    kept = BY_HAND + "\n"
    if path.exists() and BY_HAND in (before := path.read_text(encoding="utf-8")):
        kept = before[before.index(BY_HAND):]
    path.write_text(Page(results, options.quick).text(options.origin, picture.name) + "\n" + kept, encoding="utf-8")
    figure.draw(results, picture)
    print(f"{path} and {picture} written")


if __name__ == "__main__":
    main()
