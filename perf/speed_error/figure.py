# figure.py: error against speed as the time step varies, one panel for each scene.
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullLocator  # noqa: E402

from results import difference, is_significant  # noqa: E402

SPEEDS, ERRORS = (0.15, 5), (1e-3, 300)  # simulated time per step, standard = 1; %
# Quantity of the hopper, of the pile, words, colour.
BED = (("packing", "packing", "packing", "#d62728"), ("stress", "stress", "stress", "#9467bd"),
       ("rate", "angle", "rate or angle", "#ff7f0e"))
IMPACTS = (("restitution", "#1f77b4"), ("spin", "#2ca02c"))

plt.rcParams.update({"font.size": 9, "svg.fonttype": "path", "svg.hashsalt": "wedge", "axes.axisbelow": True})


def draw(results, path):
    drawing, panels = plt.subplots(1, len(results.scenes), figsize=(11, 5.4), squeeze=False)
    drawing.subplots_adjust(left=0.06, right=0.985, top=0.94, bottom=0.3, wspace=0.17)
    for panel, scene in zip(panels[0], results.scenes):
        draw_axes(panel, scene, results)
        slow, fast = draw_impacts(panel, scene, results)
        draw_residual(panel, scene, results)
        draw_bed(panel, scene, results)
    drawing.legend(handles=legend(slow, fast), loc="lower left", ncol=4, frameon=False)
    drawing.savefig(path, metadata={"Date": None})
    plt.close(drawing)


def draw_axes(panel, scene, results):
    steps, standard = results.steps(), results.standard.step
    panel.set(xscale="log", yscale="log", xlim=SPEEDS, ylim=ERRORS, ylabel="error [%]",
              xlabel="simulated time per step, standard = 1 (step, % of the Rayleigh time)")
    panel.set_title(scene, loc="left")
    panel.xaxis.set_minor_locator(NullLocator())
    panel.set_xticks([step / standard for step in steps], [f"{step / standard:g}\n({step:g} %)" for step in steps])
    panel.yaxis.set_major_formatter(FuncFormatter(lambda error, _: f"{error:g}"))
    panel.grid(axis="y", color="#ddd")


def draw_impacts(panel, scene, results):
    """Returns the two speeds [m/s]."""
    found = results.of("impact", scene)
    slow, fast = sorted({float(speed) for _, _, speed, _ in found})
    for quantity, colour in IMPACTS:
        for speed in (slow, fast):
            points = sorted((v.step / results.standard.step, 100 * numbers[quantity])
                            for (v, _, of, _), numbers in found.items() if float(of) == speed and v.step in results.steps())
            panel.plot(*zip(*points), color=colour, linestyle="--" if speed == slow else "-")
    return slow, fast


def draw_residual(panel, scene, results):
    samples = [(step, results.sample(scene, results.standard._replace(step=step), "residual_end")) for step in results.steps()]
    points = [(step / results.standard.step, 100 * abs(s.mean)) for step, s in samples if s.count]
    panel.plot(*zip(*points), color="black", linestyle=":")


def draw_bed(panel, scene, results):
    """Differences from the smallest step: a disc with its standard error where an error shows, else an open triangle at the
    bound of 99 % confidence, below which the error is. The quantities stand side by side."""
    first, *others = results.steps()
    for place, (of_hopper, of_pile, _, colour) in enumerate(BED):
        quantity = of_hopper if scene == "hopper" else of_pile
        for step in others:
            d = difference(*(results.sample(scene, results.standard._replace(step=s), quantity) for s in (step, first)))
            if d is None:
                continue
            x, error = 1.06 ** (place - 1) * step / results.standard.step, 100 * abs(d.value)
            if is_significant(d):
                ends = np.clip([error - 100 * d.standard_error, error + 100 * d.standard_error], *ERRORS)
                panel.plot([x, x], ends, color=colour, linewidth=1)
                panel.plot(x, np.clip(error, *ERRORS), "o", color=colour, markersize=5, clip_on=False)
            else:
                panel.plot(x, np.clip(error + 100 * d.bound, *ERRORS), "v", color=colour, markerfacecolor="white", markersize=6,
                           clip_on=False)


def legend(slow, fast):
    """Three entries a column: impacts and residual, impacts, quantities of the bed, what their marks mean."""
    def entry(label, **style):
        return Line2D([], [], label=label, **{"linestyle": "", **style})

    restitution, spin = ([entry(f"{quantity}, impact at {speed:g} m/s", color=colour, linestyle=style)
                          for speed, style in ((fast, "-"), (slow, "--"))] for quantity, colour in IMPACTS)
    return [*restitution, entry("residual of the energy budget", color="black", linestyle=":"), *spin, entry(" "),
            *(entry(words, color=colour, marker="o", markersize=5) for _, _, words, colour in BED),
            entry("difference from the smallest step", color="black", marker="o", markersize=5),
            entry("within the spread: the error is below this mark (99 %)", color="black", marker="v", markerfacecolor="white")]
