# tables.py: tables of the page, and how a mean with its deviation is written.
import math
from html import escape

import numpy as np

from ensembles import counted, grouped


def table(head, rows, caption, first_is_name=True):
    """Rows of texts (already HTML) as a table in a box of its own that scrolls."""
    out = [f'<p class="caption">{caption}</p>', '<div class="scroll" tabindex="0"><table><thead><tr>']
    out += [f'<th scope="col">{h}</th>' for h in head]
    out.append("</tr></thead><tbody>")
    for row in rows:
        if len(row) == 1:  # a heading within the table
            out.append(f'<tr><th class="within" scope="rowgroup" colspan="{len(head)}">{row[0]}</th></tr>')
            continue
        out.append("<tr>")
        for k, text in enumerate(row):
            out.append(f'<th scope="row">{text}</th>' if k == 0 and first_is_name else f"<td>{text}</td>")
        out.append("</tr>")
    out.append("</tbody></table></div>")
    return "".join(out)


def digits(value, of):
    """`value` to the decimals of the second digit of `of`."""
    if not math.isfinite(value):
        return "\u2013"
    if not math.isfinite(of) or of <= 0:
        return shown(value)
    decimals = 1 - math.floor(math.log10(float(f"{of:.1e}")))
    if decimals < 0 or abs(value) >= 1e6:
        return shown(value) if abs(value) >= 1e6 else f"{round(value, decimals):.0f}"
    if decimals > 6:
        return f"{value:.3e}"
    return f"{value:.{decimals}f}"


def shown(value):
    """Four digits."""
    if not math.isfinite(value):
        return "\u2013"
    if value == 0:
        return "0"
    if abs(value) >= 1e6 or abs(value) < 1e-4:
        return f"{value:.3e}"
    if abs(value) >= 1000:
        return f"{value:.0f}"
    return f"{value:.4g}"


def cell(sample):
    """Mean and standard deviation over seeds; one number from one seed."""
    if not sample.n:
        return "\u2013"
    if sample.n == 1 or not math.isfinite(sample.sd):
        return minus(shown(sample.mean))
    if sample.sd == 0:
        return minus(shown(sample.mean)) + " \u00b1 0"
    return minus(f"{digits(sample.mean, sample.sd)} \u00b1 {digits(sample.sd, sample.sd)}")


def minus(text):
    return text.replace("-", "\u2212") if "e-" not in text else text


def difference(sample, reference):
    """Relative difference of two means with half its 95 % interval [%], or None."""
    if not sample.n or not reference.n or not reference.mean:
        return None
    halves = [h for h in (sample.half, reference.half) if math.isfinite(h)]
    half = math.sqrt(sum(h * h for h in halves)) if len(halves) == 2 else float("nan")
    return 100 * (sample.mean - reference.mean) / abs(reference.mean), 100 * half / abs(reference.mean)


def percent(found):
    if found is None:
        return "\u2013"
    value, half = found
    text = f"{value:+.{1 if abs(value) >= 10 else 2}f}".replace("-", "\u2212")
    return text + (f" \u00b1 {half:.{1 if half >= 10 else 2}f}" if math.isfinite(half) else "")


def duration(seconds):
    if not math.isfinite(seconds):
        return "\u2013"
    hours, rest = divmod(int(round(seconds)), 3600)
    return f"{hours}:{rest // 60:02d}:{rest % 60:02d}" if hours else f"{rest // 60}:{rest % 60:02d}"


def heads(members):
    return [f"{escape(e.label)}<br><small>{counted(len(e.runs), 'seed')}</small>" for e in members]


def scalars(vessel, moment, members=None):
    """Every quantity of a moment, for each ensemble."""
    members = members or vessel.gallery
    names = []
    for e in members:
        for run in e.runs:
            names += [n for n in run.scalar_names(moment) if n not in names]
    rows = []
    for name in names:
        unit = next((u for u in (e.unit(moment, name) for e in members) if u), "")
        samples = [e.scalar(moment, name) for e in members]
        if any(s.n for s in samples):
            rows.append([f"<code>{escape(name)}</code>" + (f" [{escape(unit)}]" if unit not in ("", "-") else "")]
                        + [cell(s) for s in samples])
    if not rows:
        return ""
    return table(["quantity"] + heads(members), rows,
                 f"Moment: {escape(vessel.when(moment))}. Means over seeds \u00b1 standard deviation over seeds; whole vessel.")


GLANCE = [("packing", "rest"), ("cn", "rest"), ("cn", "mean"), ("axis_zone_cn", "mean"), ("load", "mean"), ("speed", "mean"),
          ("axis_density_1d", "mean"), ("discharge_rate", "mean"), ("arched", "mean"), ("angle_of_repose", "end")]


def glance(vessel):
    """Sectors against the full vessel: the few numbers that matter first."""
    members = [e for e in vessel.gallery if not e.full]
    if vessel.full is None or not members:
        return ""
    roles, rows = vessel.roles(), []
    for name, role in GLANCE:
        moment = roles[role]
        base = vessel.full.scalar(moment, name)
        samples = [e.scalar(moment, name) for e in members]
        if not base.n or not any(s.n for s in samples) or (name == "arched" and not vessel.hopper):
            continue
        row = [f"<code>{name}</code>, {escape(str(moment))}", cell(base)]
        for sample in samples:
            if name == "arched":
                row.append(f"{int(sample.values.sum())} of {sample.n}")
            else:
                row.append(f"{percent(difference(sample, base))} %" if sample.n else "\u2013")
        if name == "discharge_rate":
            flowing = [e.flowing(moment, name) for e in members]
            if any(f.n != s.n for f, s in zip(flowing, samples)):
                rows.append(row)
                base = vessel.full.flowing(moment, name)
                row = [f"<code>{name}</code> of runs that flow", cell(base)]
                row += [f"{percent(difference(f, base))} %<br><small>{f.n} of {s.n}</small>" if f.n else "\u2013"
                        for f, s in zip(flowing, samples)]
        if name == "arched":
            row[1] = f"{int(base.values.sum())} of {base.n}"
        rows.append(row)
    head = ["quantity, moment"] + heads([vessel.full] + members)
    return table(head, rows, "Full vessel: mean \u00b1 standard deviation over seeds. Sectors: difference of the means to the full "
                 "vessel in per cent \u00b1 half width of its 95 % interval (Student's t over seeds). Arched: runs that had stopped."
                 ) if rows else ""


def costs(vessel):
    """The paper's Tables 1 and 2: wall time, full and by the slice."""
    rows, base = [], None
    for e in vessel.ensembles:
        cost = [run.cost for run in e.runs if run.cost.get("wall_seconds")]
        if not cost:
            continue
        mean = {k: float(np.mean([c.get(k) or np.nan for c in cost])) for k in
                ("grains", "steps", "wall_seconds", "threads", "particle_steps_per_second")}
        base = base or (mean["wall_seconds"] if e.full else None)
        rows.append([escape(e.label), str(len(cost)), grouped(int(mean["grains"])), grouped(int(mean["steps"])),
                     duration(mean["wall_seconds"]), f"{base / mean['wall_seconds']:.1f}" if base else "\u2013",
                     f"{mean['particle_steps_per_second'] / 1e6:.1f}", f"{mean['threads']:g}",
                     escape(", ".join(sorted({c.get("precision") or "?" for c in cost})))])
    head = ["ensemble", "runs", "grains", "steps", "wall time", "times faster than full", "million grain steps / s", "threads",
            "precision"]
    return table(head, rows, "Means over the runs. The machine was shared: wall times are what the runs took, not a benchmark."
                 ) if rows else ""
