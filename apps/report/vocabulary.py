# vocabulary.py: the names, units, labels and definitions that the program has, from the vocabulary.json it leaves here.
import json
import os
from html import escape

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "vocabulary.json"), encoding="utf-8") as file:
    VOCABULARY = json.load(file)
QUANTITIES = {q["name"]: q for q in VOCABULARY["quantities"]}
AXIS_ZONE_ARC = VOCABULARY["axis_zone_arc_d"]  # where the axis zone ends, in d


def quantities(table, overview=False):
    """Names of the quantities of a table ("scalars", "distributions", "profile", "map") that are compared."""
    return [q["name"] for q in VOCABULARY["quantities"]
            if table in q["tables"] and q["compared"] and (q["in_overview"] or not overview)]


def label(name):
    """For people; of a quantity of another version its name."""
    return QUANTITIES[name]["label"] if name in QUANTITIES else name


def with_unit(name):
    unit = QUANTITIES[name]["unit"] if name in QUANTITIES else ""
    return label(name) + (f" [{unit}]" if unit else "")


def angle_label(order):
    """51.4\u00b0 of one of seven sectors."""
    return f"{round(360 / order, 1):g}\u00b0"


def axis_zone(order):
    """The region of distributions.csv that is the axis zone of one of `order` sectors."""
    return VOCABULARY["regions"]["axis_zone"]["of_sectors"].format(n=order)


def region_label(region):
    """Of a region of a comparison: "axis zone"."""
    return VOCABULARY["regions"].get(region, {}).get("label", region)


def definitions():
    """Every quantity by table, each defined where it stands first, as HTML."""
    out, told = [], set()
    for table in VOCABULARY["tables"]:
        rows = [q for q in VOCABULARY["quantities"] if table["name"] in q["tables"] and q["name"] not in told]
        told |= {q["name"] for q in rows}
        out.append(f"<h4>{escape(table['file'])}</h4><p>{escape(table['says'])}</p>")
        out.append('<div class="scroll" tabindex="0"><table class="words"><thead><tr><th scope="col">quantity</th>'
                   '<th scope="col">unit</th><th scope="col">kind</th><th scope="col">definition</th></tr></thead><tbody>')
        out += [f"<tr><td><code>{escape(q['name'])}</code></td><td>{escape(q['unit'] or chr(0x2013))}</td>"
                f"<td>{escape(q['kind'].replace('_', ' '))}</td>"
                f"<td><strong>{escape(q['label'])}</strong>: {escape(q['definition'])}</td></tr>" for q in rows]
        out.append("</tbody></table></div>")
    return "".join(out)
