# page.py: the HTML page: one file, nothing from elsewhere.
import os
import shlex
from html import escape

from ensembles import counted, grouped
from tables import duration, table
from vocabulary import angle_label

STYLE = """
:root { color-scheme: light dark; --ink: #1b1f24; --soft: #57606a; --line: #d5d9de; --paper: #ffffff; --ground: #f6f7f8;
  --accent: #23527c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e7e9ec; --soft: #a3abb4; --line: #3a4149; --paper: #1b1f24;
  --ground: #14171b; --accent: #8fbde6; } }
* { box-sizing: border-box; }
html { scroll-behavior: smooth; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto,
  "Helvetica Neue", Arial, sans-serif; overflow-wrap: break-word; }
main, header, footer { max-width: 74rem; margin: 0 auto; padding: 0 1.1rem; }
header { padding-top: 2.2rem; }
h1 { font-size: clamp(1.5rem, 4.5vw, 2.3rem); line-height: 1.2; margin: 0 0 .4rem; text-wrap: balance; }
h2 { font-size: clamp(1.25rem, 3.5vw, 1.6rem); line-height: 1.25; margin: 3rem 0 .6rem; padding-top: .9rem; border-top: 2px solid var(--line); }
h3 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
h4, h5, h6 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
p { max-width: 46rem; margin: .5rem 0; }
.soft, small { color: var(--soft); }
a { color: var(--accent); }
nav { background: var(--paper); border: 1px solid var(--line); border-radius: 8px; padding: .7rem 1.1rem; margin: 1.3rem 0; }
nav > ol { columns: 22rem 2; column-gap: 2rem; }
nav ol { margin: .2rem 0; padding-left: 1.3rem; }
nav > ol > li { break-inside: avoid; margin-bottom: .5rem; }
nav ol ol { list-style: none; padding-left: 0; font-size: .88rem; line-height: 1.4; }
figure { margin: 1.4rem 0; padding: .9rem; background: #fff; color: #1b1f24; border: 1px solid var(--line); border-radius: 8px; }
figure h3 { margin: 0 0 .5rem; font-size: 1.05rem; }
figure small, figure .soft, figure .caption, figure figcaption { color: #57606a; }
figure .scroll, figure .scroll th { background: #fff; color: #1b1f24; border-color: #d5d9de; } figure .scroll td { border-color: #d5d9de; }
.images { display: grid; gap: .5rem .7rem; align-items: start; }
.strip .images { grid-template-columns: repeat(auto-fit, minmax(min(10.5rem, 44%), 13rem)); }
.panels .images { grid-template-columns: repeat(auto-fill, minmax(min(18rem, 100%), 1fr)); }
.curves .images { grid-template-columns: repeat(auto-fill, minmax(min(20rem, 100%), 1fr)); }
.wide .images { grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr)); }
.image { min-width: 0; text-align: center; }
.image img { display: block; width: 100%; height: auto; margin: 0 auto; }
.strip .image img { max-width: 13rem; } .panels .image img { max-width: 34rem; } .curves .image img, .wide .image img { max-width: 34rem; }
.image span { display: block; font-size: .84rem; color: #3c444d; }
.scale img { display: block; width: 100%; max-width: 25rem; height: auto; margin: .6rem auto 0; }
figcaption { font-size: .88rem; line-height: 1.45; margin-top: .6rem; max-width: 56rem; }
.paper { font-weight: 400; color: #57606a; font-size: .9rem; white-space: nowrap; }
.scroll { overflow: auto; max-width: 100%; max-height: 34rem; margin: .8rem 0; border: 1px solid var(--line); border-radius: 8px;
  background: var(--paper); color: var(--ink); }
figure .scroll { margin: .8rem 0 0; }
.scroll small { color: var(--soft); }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; width: 100%; }
.caption { color: var(--soft); font-size: .86rem; line-height: 1.45; margin: 1rem 0 .35rem; max-width: 56rem; } .caption + .scroll { margin-top: 0; }
th, td { padding: .28rem .7rem; text-align: right; border-top: 1px solid var(--line); white-space: nowrap; vertical-align: top; }
thead th { position: sticky; top: 0; background: var(--paper); border-top: 0; vertical-align: bottom; }
tbody th { position: sticky; left: 0; background: var(--paper); } tbody .within { font-weight: 650; padding-top: .7rem; }
tbody th, th:first-child, .words td, .words th { text-align: left; font-weight: 500; }
.words td { white-space: normal; font-weight: 400; min-width: 6rem; }
.words td:last-child { min-width: 16rem; }
code, pre { font-family: ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; font-size: .86em; }
pre { overflow: auto; max-height: 30rem; background: var(--paper); border: 1px solid var(--line); border-radius: 8px; padding: .7rem .9rem;
  line-height: 1.45; }
footer { padding: 2rem 1.1rem 3rem; color: var(--soft); font-size: .88rem; }
@media (max-width: 40rem) { main, header, footer { padding-left: .7rem; padding-right: .7rem; } figure { padding: .6rem; }
  nav > ol { columns: 1; } nav ol ol { display: none; } .strip .images { grid-template-columns: 1fr 1fr; gap: .4rem .2rem; }
  tbody th:not(.within) { white-space: normal; min-width: 6.5rem; max-width: 9rem; } th, td { padding-left: .45rem; padding-right: .45rem; } }
@media print { @page { size: A4; margin: 14mm 12mm; }
  :root { --ink: #000; --soft: #444; --line: #bbb; --paper: #fff; --ground: #fff; --accent: #000; }
  body { font-size: 9.5pt; background: #fff; } main, header, footer { max-width: none; padding: 0; } a { text-decoration: none; }
  .scroll, pre { overflow: visible; max-height: none; } pre { white-space: pre-wrap; } thead th { position: static; }
  table { font-size: 7pt; } th, td { padding: .1rem .3rem; white-space: normal; } td { min-width: 0 !important; }
  nav > ol { columns: 2; } .yard { display: none; }
  figure { border: 0; padding: 0; break-inside: avoid; } .images { break-before: avoid; } .image { break-inside: avoid; } figcaption { break-before: avoid; } h2, h3, h4 { break-after: avoid; }
  tr { break-inside: avoid; } .strip .images { grid-template-columns: repeat(5, 1fr); } .wide .images { grid-template-columns:
  repeat(2, 1fr); } .panels .images { grid-template-columns: repeat(3, 1fr); } .curves .images { grid-template-columns: repeat(3, 1fr); }
  .strip .image img { max-height: 150mm; width: auto; max-width: 100%; } }
"""


class Section:
    """A part of the page: figures, tables and text in their order, each with a title for the contents."""

    def __init__(self, id_, title, intro=""):
        self.id, self.title, self.intro, self.parts = id_, title, intro, []

    def figure(self, figure):
        if figure is not None and (figure.images or figure.extra):
            self.parts.append(figure)

    def text(self, title, html):
        if html:
            self.parts.append((title, html))


def figure_html(figure, id_, number):
    paper = f' <span class="paper">\u2014 as the paper\u2019s Fig. {figure.paper}</span>' if figure.paper else ""
    out = [f'<figure id="{id_}" class="{figure.layout}"><h3>Figure {number}. {escape(figure.title)}{paper}</h3><div class="images">']
    for image in figure.images:
        label = f"<span>{escape(image.label)}</span>" if image.label else ""
        out.append(f'<div class="image"><img src="{image.uri}" alt="{escape(image.alt)}">{label}</div>')
    out.append("</div>")
    if figure.scale is not None:
        out.append(f'<div class="scale"><img src="{figure.scale.uri}" alt="{escape(figure.scale.alt)}"></div>')
    out.append(f"<figcaption>{escape(figure.caption)}</figcaption>{figure.extra}</figure>")
    return "".join(out)


def section_html(section, number):
    """The section, its entry in the contents, and the number of the next figure."""
    body = [f'<section id="{section.id}"><h2>{escape(section.title)}</h2>{section.intro}']
    entries = []
    for k, part in enumerate(section.parts):
        id_ = f"{section.id}-{k + 1}"
        if isinstance(part, tuple):
            body.append(f'<section id="{id_}"><h3>{escape(part[0])}</h3>{part[1]}</section>')
            entries.append(f'<li><a href="#{id_}">{escape(part[0])}</a></li>')
        else:
            body.append(figure_html(part, id_, number))
            entries.append(f'<li><a href="#{id_}">Fig. {number}. {escape(part.title)}</a></li>')
            number += 1
    body.append("</section>")
    inner = f"<ol>{''.join(entries)}</ol>" if entries else ""
    return "\n".join(body), f'<li><a href="#{section.id}">{escape(section.title)}</a>{inner}</li>', number


def page(title, lead, sections, foot):
    bodies, contents, number = [], [], 1
    for section in sections:
        body, entry, number = section_html(section, number)
        bodies.append(body)
        contents.append(entry)
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{escape(title)}</title>\n'
            f'<link rel="icon" href="data:,">\n<style>{STYLE}</style>\n</head>\n<body>\n<header><h1>{escape(title)}</h1>\n{lead}</header>\n'
            f'<main>\n<nav aria-label="Contents"><ol>{"".join(contents)}</ol></nav>\n' + "\n".join(bodies)
            + f"\n</main>\n<footer>{foot}</footer>\n</body>\n</html>\n")


def short_path(word):
    """A path with its last two names; other words as they are."""
    if word.startswith("-") or "=" in word or "/" not in word:
        return word
    return os.path.join(*[part for part in word.split("/") if part not in ("", ".", "..")][-2:])


def command_of(run):
    words = run.provenance.get("command_line") or []
    return " ".join(["wedge"] + [shlex.quote(short_path(str(word))) for word in words[1:]]) if words else ""


def provenance(runs):
    rows = []
    for run in runs:
        p, cost = run.provenance, run.cost
        bounds = f", {run.sides}, axis {run.axis}" if run.kind == "sector" else ""
        rows.append([f"<code>{escape(run.name)}</code>", escape(f"{run.kind} {angle_label(run.order)}{bounds}" if run.kind == "sector" else run.kind),
                     str(run.seed), escape(f"{p.get('version', '?')} ({p.get('git_describe', '?')})"), escape(str(p.get("precision", "?"))),
                     grouped(int(cost.get("grains") or 0)), duration(cost.get("wall_seconds") or float("nan")),
                     str(p.get("threads", "?")), escape(str(p.get("processor", "?"))), escape(str(p.get("compiler", "?"))),
                     escape(str(p.get("started", "?")))])
    head = ["run", "domain", "seed", "wedge", "precision", "grains", "wall time", "threads", "processor", "compiler", "started"]
    return table(head, rows, f"{counted(len(rows), 'run')}. Grains: those of the domain.")


def commands(runs, comparisons, own):
    """What was typed, as far as runs know it."""
    lines = ["# each run, as it was started (paths cut to their last two names)"]
    lines += [command for command in (command_of(run) for run in runs) if command]
    lines += ["", "# what each measured", "wedge analyse DIR              # of full vessels with --wedges N, for the yardstick", "", "# errors against full vessels"]
    lines += [f"# {c.name}.csv" for c in comparisons]
    lines += ["wedge compare FULL... --with SECTOR... --csv FILE", "", "# this page", own]
    return f'<pre tabindex="0"><code>{escape(chr(10).join(lines))}</code></pre>'
