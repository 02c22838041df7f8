# __main__.py: wedge report: reads result files of runs, draws the figures, writes one HTML page.
import argparse
import glob
import os
import shlex
import sys
import time
from html import escape

import figures_axis
import figures_distributions
import figures_errors
import figures_flow
import figures_maps
import figures_pictures
import figures_scalars
import figures_study
import markdown
import tables
import vocabulary
from ensembles import counted, grouped, sort_into_vessels
from page import Section, commands, page, provenance
from read import find_runs

HERE = os.path.dirname(os.path.abspath(__file__))
NARROW = "How narrow may a sector be?"
TITLE = "Granular flow, whole and by the slice"
MOST_ANGLES = 6  # a vessel with more angles, or without maps, is there for the study of the angle: it gets no gallery


def hopper(section, v):
    roles, weight = v.roles(), figures_pictures.vessel_weight(v)
    rest, at, mean, end = (roles[name] for name in ("rest", "instant", "mean", "end"))
    section.figure(figures_pictures.slices(v, at, "5"))
    if end not in (at, rest):
        section.figure(figures_pictures.slices(v, end))
    section.figure(figures_pictures.cuts(v, at, "6"))
    section.figure(figures_maps.maps(v, "cn", at, "7"))
    section.figure(figures_maps.maps(v, "cn", mean, "7, averaged over time"))
    section.figure(figures_maps.differences(v, "cn", mean))
    section.figure(figures_distributions.cn_distributions(v, [rest, at, mean], "8"))
    section.figure(figures_axis.cn_arc(v, [rest, at, mean], "9"))
    section.figure(figures_axis.corrected(v, [at, mean], "10"))
    section.figure(figures_maps.maps(v, "vz", at, "11"))
    section.figure(figures_maps.maps(v, "vz", mean, "11, averaged over time"))
    section.figure(figures_maps.differences(v, "vz", mean))
    section.figure(figures_distributions.velocities(v, [at, mean], "12"))
    section.figure(figures_pictures.networks(v, at, "13"))
    section.figure(figures_distributions.forces(v, [at, mean], weight, "14"))
    section.figure(figures_distributions.loads(v, [rest, at, mean], weight))
    section.figure(figures_flow.discharge(v, [mean]))
    section.figure(figures_maps.zones(v, mean))
    section.figure(figures_maps.maps(v, "packing", mean))
    section.figure(figures_maps.maps(v, "pressure", mean))
    section.figure(figures_axis.profiles(v, mean))
    section.figure(figures_axis.axis_mass(v, [rest, mean]))


def pile(section, v):
    roles, weight = v.roles(), figures_pictures.vessel_weight(v)
    rest, at, second, mean, end = (roles[name] for name in ("rest", "instant", "second", "mean", "end"))
    section.figure(figures_pictures.slices(v, at, "16"))
    section.figure(figures_pictures.slices(v, second))
    if end not in (at, second):
        section.figure(figures_pictures.slices(v, end))
    section.figure(figures_pictures.cuts(v, second, "16, horizontal cut"))
    section.figure(figures_maps.maps(v, "cn", at, "17"))
    section.figure(figures_maps.maps(v, "cn", mean, "17, averaged over time"))
    section.figure(figures_distributions.cn_distributions(v, [at, mean, end], "18"))
    section.figure(figures_axis.cn_arc(v, [rest, at, end]))
    section.figure(figures_maps.maps(v, "vz", at, "19"))
    section.figure(figures_maps.maps(v, "vz", mean, "19, averaged over time"))
    section.figure(figures_maps.differences(v, "vz", mean))
    section.figure(figures_distributions.velocities(v, [at, mean], "20"))
    section.figure(figures_pictures.networks(v, at, "21"))
    section.figure(figures_distributions.forces(v, [at, mean], weight, "22"))
    section.figure(figures_distributions.loads(v, [at, end], weight))
    section.figure(figures_flow.repose(v, end))
    section.figure(figures_maps.maps(v, "packing", at))
    section.figure(figures_maps.maps(v, "pressure", at))
    section.figure(figures_axis.profiles(v, mean))
    section.figure(figures_axis.axis_mass(v, [rest, end]))


def slot(section, v):
    roles = v.roles()
    section.figure(figures_pictures.slices(v, roles["instant"]))
    section.figure(figures_pictures.networks(v, roles["instant"]))


def gallery(v):
    members = ", ".join(f"{e.label} (seed{'s' if len(e.runs) != 1 else ''} {e.seeds()})" for e in v.gallery)
    section = Section(v.id, v.title, f"<p>{escape(members)}. d = {1e3 * v.d:g} mm.</p>")
    section.text("At a glance", tables.glance(v))
    (slot if not v.main else hopper if v.hopper else pile)(section, v)
    section.text("Wall time (as the paper\u2019s Table " + ("1)" if v.hopper else "2)"), tables.costs(v))
    roles = v.roles()
    moments = dict.fromkeys(roles[name] for name in ("rest", "instant", "second", "mean", "end") if roles[name])
    section.figure(figures_scalars.by_angle(v, [roles["rest"], roles["mean"] or roles["end"]]))
    section.text("All numbers", "".join(tables.scalars(v, moment) for moment in moments))
    return section


def study(vessels, comparisons):
    sections = []
    for v in vessels:
        found = figures_study.sides(v, vessels)
        if found is not None:
            section = Section(v.id + "-sides", f"Sides and axis: {v.title}")
            section.figure(found)
            sections.append(section)
    figures, angles = figures_study.smallest_angles(vessels)
    if figures:
        section = Section("smallest-angle", NARROW, "<p>In this section colours and markers stand for vessels (but for those of "
                          "Beverloo\u2019s law, which stand for angles).</p>")
        section.text("Smallest angles", angles)
        for figure in figures:
            section.figure(figure)
        sections.append(section)
    if comparisons:
        section = Section("errors", "Errors against the full vessel")
        for name, members in figures_errors.groups(comparisons):
            section.figure(figures_errors.figure(name, members))
            section.text(f"Table of errors: {name}", figures_errors.error_table(name, members))
        sections.append(section)
    return sections


def overview(vessels):
    rows = []
    for v in vessels:
        rows.append([f'<a href="#{v.id}">{escape(v.title)}</a>' if v in chosen(vessels) else escape(v.title)])
        rows += [[escape(e.label), escape(e.seeds()), grouped(round(v.count / e.order)),
                  escape(", ".join(dict.fromkeys(m for r in e.runs for m in r.moments())))] for e in v.ensembles]
    return tables.table(["ensemble", "seeds", "grains in the domain", "moments"], rows, "Vessels, ensembles and their seeds.")


def chosen(vessels):
    few = [v for v in vessels if len({e.angle for e in v.main}) <= MOST_ANGLES
           and any(run.table("map") is not None for e in v.ensembles for run in e.runs)]
    return few or vessels


def own_command(arguments):
    """What was typed; all CSV files of a folder as one pattern."""
    files = []
    for folder in dict.fromkeys(map(os.path.dirname, arguments.compare)):
        given = [file for file in arguments.compare if os.path.dirname(file) == folder]
        whole = set(given) == set(glob.glob(os.path.join(glob.escape(folder), "*.csv")))
        files += [os.path.join(shlex.quote(folder), "*.csv")] if folder and whole else map(shlex.quote, given)
    words = ["wedge report"] + [shlex.quote(f) for f in arguments.folders]
    words += ["--compare"] + files if files else []
    words += ["-o " + shlex.quote(arguments.output)]
    return " ".join(words + ([f"--title {shlex.quote(arguments.title)}"] if arguments.title != TITLE else []))


def main():
    parser = argparse.ArgumentParser(prog="wedge report")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--compare", action="append", default=[])
    parser.add_argument("--title", default=TITLE)
    parser.add_argument("--version-text", default="")
    arguments = parser.parse_args()
    runs, found = find_runs(arguments.folders)
    if not runs:
        print(f"wedge: no results in {', '.join(arguments.folders)}: run `wedge analyse` first", file=sys.stderr)
        return 4
    files = list(dict.fromkeys([os.path.abspath(f) for f in arguments.compare] + found))
    comparisons = [figures_errors.Comparison(f) for f in files]
    vessels = sort_into_vessels(runs)
    lead = ("<p>Full vessels beside sectors of 360/n degrees with rotated, periodic faces: flow patterns, coordination numbers, "
            "velocities, forces, discharge and heaps, drawn like the figures of Yang, Zhou, Pinson and Yu, <cite>Ind. Eng. Chem. "
            f"Res.</cite> 53 (2014) 8245\u20138256. {counted(len(runs), 'run')} in {counted(len(vessels), 'vessel')}.</p>"
            "<p class=\"soft\">Curves are means over runs that differ in their seed alone, with a band of one standard deviation over "
            "seeds; pictures are of the lowest seed. Lengths are in grain diameters d. Colours stand for the same angle throughout"
            + (f", but in \u201c{NARROW}\u201d for vessels" if figures_study.studied(vessels) else "") + ".</p>")
    sections = [Section("overview", "What was run")]
    sections[0].parts.append(("Vessels and seeds", overview(vessels)))
    sections += [gallery(v) for v in chosen(vessels)] + study(vessels, comparisons)
    definitions = Section("definitions", "Definitions")
    for name, more in (("analysis.md", vocabulary.definitions()), ("comparison.md", "")):
        with open(os.path.join(HERE, name), encoding="utf-8") as file:
            definitions.intro += markdown.to_html(file.read(), 3) + more
    origin = Section("provenance", "Provenance")
    origin.text("Runs", provenance(runs))
    origin.text("Commands that reproduce this page", commands(runs, comparisons, own_command(arguments)))
    foot = f"Made by wedge {escape(arguments.version_text)}, {time.strftime('%Y-%m-%d', time.gmtime())}."
    text = page(arguments.title, lead, sections + [definitions, origin], foot)
    part = arguments.output + ".part"
    with open(part, "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(part, arguments.output)
    print(f"{arguments.output}: {len(runs)} runs, {text.count('<figure ')} figures, {text.count('<img ')} images, "
          f"{len(text) / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except OSError as error:
        print(f"wedge: {error.strerror}: {error.filename}", file=sys.stderr)
        sys.exit(4)
