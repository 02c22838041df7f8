# markdown.py: headings, paragraphs, tables and code of a README as HTML.
import re
from html import escape


def inline(text):
    """`code`, **bold** and quotes of a line; everything else is text."""
    parts = re.split(r"(`[^`]+`)", text)
    out = []
    for part in parts:
        if part.startswith("`") and part.endswith("`") and len(part) > 2:
            out.append(f"<code>{escape(part[1:-1])}</code>")
        else:
            out.append(re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", escape(part, quote=False)))
    return "".join(out)


def cells(line):
    return [c.strip() for c in line.strip().strip("|").split("|")]


def to_html(text, heading_level):
    """Headings become those of `heading_level` and deeper."""
    out, lines, k = [], text.splitlines(), 0
    while k < len(lines):
        line = lines[k]
        if not line.strip():
            k += 1
        elif line.startswith("#"):
            depth = len(line) - len(line.lstrip("#"))
            level = min(heading_level + depth - 1, 6)
            out.append(f"<h{level}>{inline(line.lstrip('# '))}</h{level}>")
            k += 1
        elif line.startswith("    "):
            block = []
            while k < len(lines) and (lines[k].startswith("    ") or not lines[k].strip()):
                block.append(lines[k][4:])
                k += 1
            out.append(f"<pre tabindex=\"0\"><code>{escape(chr(10).join(block).rstrip())}</code></pre>")
        elif line.startswith("|") and k + 1 < len(lines) and re.fullmatch(r"[|\-: ]+", lines[k + 1]):
            head = cells(line)
            k += 2
            out.append('<div class="scroll" tabindex="0"><table class="words"><thead><tr>'
                       + "".join(f'<th scope="col">{inline(c)}</th>' for c in head) + "</tr></thead><tbody>")
            while k < len(lines) and lines[k].startswith("|"):
                out.append("<tr>" + "".join(f"<td>{inline(c)}</td>" for c in cells(lines[k])) + "</tr>")
                k += 1
            out.append("</tbody></table></div>")
        elif line.startswith("- "):
            out.append("<ul>")
            while k < len(lines) and (lines[k].startswith("- ") or lines[k].startswith("  ")):
                item = lines[k][2:]
                k += 1
                while k < len(lines) and lines[k].startswith("  "):
                    item += " " + lines[k].strip()
                    k += 1
                out.append(f"<li>{inline(item)}</li>")
            out.append("</ul>")
        else:
            block = []
            while k < len(lines) and lines[k].strip() and not re.match(r"[#|]|- |    ", lines[k]):
                block.append(lines[k])
                k += 1
            out.append(f"<p>{inline(' '.join(block))}</p>")
    return "\n".join(out)
