# style.py: how figures look: one colour and one marker per angle everywhere, and how a figure becomes an image of the page.
import base64
import io
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import MultipleLocator  # noqa: E402
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap, to_rgb  # noqa: E402

plt.rcParams.update({
    "font.size": 9, "axes.labelsize": 9.5, "axes.titlesize": 9.5, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5,
    "legend.fontsize": 8.5, "legend.frameon": False, "axes.spines.top": False, "axes.spines.right": False,
    "axes.linewidth": 0.8, "lines.linewidth": 1.5, "lines.markersize": 4.5, "svg.fonttype": "path",
    "svg.hashsalt": "wedge", "figure.facecolor": "white", "axes.unicode_minus": True, "mathtext.default": "regular",
    "axes.grid": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.6, "axes.axisbelow": True,
})

FULL = "#1c1c1c"
MARKERS = {90: "s", 60: "^", 45: "D", 30: "v", 180: "P", 120: "X", 72: "p", 36: "<", 24: ">", 20: "h", 15: "*"}
# Where an angle stands on the map of colours (plasma: even in lightness, safe for colour-blind readers).
PLACES = [(15, 0.90), (30, 0.80), (45, 0.62), (60, 0.42), (90, 0.20), (180, 0.03)]
SEQUENTIAL = plt.get_cmap("viridis")
DIVERGING = plt.get_cmap("RdBu_r")
HEAT = LinearSegmentedColormap.from_list("load", ["#f6e3c5", "#e9a15b", "#c8452f", "#5b1127"])
ZONES = ListedColormap(["#f4f1ea", "#8c9bb0", "#e9c46a", "#c8553d"])
BANDS = ["#23395b", "#f2c14e", "#5da9a1", "#f4e3c1", "#c8553d"]


def colour(ensemble):
    if ensemble.full:
        return FULL
    if ensemble.kind == "slot":
        return "#5a8f3c"
    angles = np.log([p[0] for p in PLACES])
    return plt.get_cmap("plasma")(np.interp(np.log(ensemble.angle), angles, [p[1] for p in PLACES]))


def marker(ensemble):
    return "o" if ensemble.full else MARKERS.get(round(ensemble.angle), "d")


def line_style(ensemble):
    """Plain ensembles are drawn solid, those with other sides or another axis dashed."""
    return {"color": colour(ensemble), "linewidth": 2.2 if ensemble.full else 1.5,
            "linestyle": "-" if ensemble.plain else "--", "zorder": 3 if ensemble.full else 2.5}


class Image:
    """One picture of a figure: what the page embeds, what it is called, what it shows in words."""

    def __init__(self, uri, alt, label=""):
        self.uri, self.alt, self.label = uri, alt, label


class Figure:
    """A numbered figure of the page. layout: `strip` (slim panels, five in a row), `panels` (wide ones), `curves`."""

    def __init__(self, title, images, caption, paper=None, layout="curves", extra=""):
        self.title, self.caption, self.paper = title, caption, paper
        self.images = [image for image in images if image is not None]
        self.layout, self.extra = layout, extra
        self.scale = next((image for image in self.images if image.alt.startswith("Colour scale")), None)
        self.images = [image for image in self.images if image is not self.scale]


def svg(figure):
    """Closes a figure of lines and returns it as a data URI."""
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    text = out.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"\n\s*", "\n", re.sub(r"<!--.*?-->", "", text, flags=re.S))
    text = re.sub(r' d="([^"]*)"', lambda path: f' d="{short_path(path[1])}"', text)
    text = re.sub(r'<g id="[^"]*"', "<g", text)  # names that nothing refers to
    text = re.sub(r'(?<= )([xy])="(-?\d+\.\d)\d+"', r'\1="\2"', text)
    text = re.sub(r"\s+", " ", text.replace(": ", ":").replace("; ", ";").replace("> <", "><")).replace('"', "'")
    for sign in ("%", "#", "<", ">", " ", "&", "{", "}"):
        text = text.replace(sign, f"%{ord(sign):02X}")
    return "data:image/svg+xml," + text


def short_path(text):
    """Path data to a tenth of a point, without needless blanks."""
    text = re.sub(r"(\d+\.\d)\d+", r"\1", text)
    return re.sub(r"\s+", ",", re.sub(r"\s*([A-Za-z])\s*", r"\1", text.strip()))


def raster(figure, dpi=200, quality=78):
    """Closes a figure with a picture in it and returns it as a data URI: WebP where Pillow can, else PNG."""
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=dpi)
    plt.close(figure)
    try:
        from PIL import Image as Pillow
        small = io.BytesIO()
        Pillow.open(io.BytesIO(out.getvalue())).convert("RGB").save(small, "WEBP", quality=quality, method=4)
        return "data:image/webp;base64," + base64.b64encode(small.getvalue()).decode()
    except (ImportError, KeyError, OSError):
        return "data:image/png;base64," + base64.b64encode(out.getvalue()).decode()


def panel(x_range, y_range, width=None):
    """A figure with one axes in which both directions have the same scale, in units of d; sizes in inches."""
    across, up = x_range[1] - x_range[0], y_range[1] - y_range[0]
    width = width or (1.55 if up > 1.4 * across else 2.6)
    height = width * up / across
    left, right, bottom, top = 0.46, 0.08, 0.4, 0.1
    figure = plt.figure(figsize=(width + left + right, height + bottom + top))
    axes = figure.add_axes([left / (width + left + right), bottom / (height + bottom + top),
                            width / (width + left + right), height / (height + bottom + top)])
    axes.set_xlim(*x_range)
    axes.set_ylim(*y_range)
    axes.grid(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(length=2.5, pad=2)
    axes.set_xlabel("x / d")
    axes.set_ylabel("z / d", labelpad=0)
    for axis, extent in ((axes.xaxis, across), (axes.yaxis, up)):
        axis.set_major_locator(MultipleLocator(5 if extent < 30 else 10 if extent < 60 else 20))
    return figure, axes


def strip_layout(x_range, y_range):
    return "strip" if y_range[1] - y_range[0] > 1.4 * (x_range[1] - x_range[0]) else "panels"


def scale_bar(cmap, low, high, label, ticks=None, names=None, boundaries=None, extend="neither"):
    """A colour scale by itself, lying."""
    figure = plt.figure(figsize=(4.2, 0.62))
    axes = figure.add_axes([0.05, 0.66, 0.9, 0.26])
    norm = BoundaryNorm(boundaries, cmap.N) if boundaries is not None else plt.Normalize(low, high)
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, cmap), cax=axes, orientation="horizontal", ticks=ticks,
                          extend=extend)
    if names:
        bar.ax.set_xticklabels(names)
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(length=2.5, pad=2)
    bar.set_label(label, labelpad=2)
    return Image(svg(figure), f"Colour scale: {label}", "")


def curves(height=3.0, width=3.7, rows=1, ratios=None, sharex=True):
    """A figure of curves, one axes above the other."""
    figure, axes = plt.subplots(rows, 1, figsize=(width, height), sharex=sharex, squeeze=False,
                                gridspec_kw={"height_ratios": ratios or [1] * rows}, constrained_layout=True)
    return figure, axes[:, 0]


def draw_walls(axes, walls, d, **style):
    """Profiles (r, z) on both sides of the axis."""
    look = {"color": "#333333", "linewidth": 1.4, "solid_capstyle": "round", "zorder": 5, "clip_on": True}
    look.update(style)
    for wall in walls:
        points = np.array(wall, dtype=float) / d
        for side in (1, -1):
            axes.plot(side * points[:, 0], points[:, 1], **look)


def rgb(value):
    return np.array(to_rgb(value))
