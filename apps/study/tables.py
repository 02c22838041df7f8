#!/usr/bin/env python3
"""tables.py [COMPARISONS] [--check]: puts the tables of rule.py and findings.py into README.md, or checks them."""
import contextlib
import io
import pathlib
import re
import sys

import findings
import rule

README = pathlib.Path(__file__).parent / "README.md"


def printed(function, *arguments):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        function(*arguments)
    return out.getvalue().strip()


def between(text, name, content):
    found = re.search(rf"(?<=<!-- {name} -->\n).*?(?=\n<!-- end of {name} -->)", text, re.S)
    if not found:
        sys.exit(f"error: {README.name} has no place for '{name}'")
    return text[:found.start()] + content + text[found.end():]


def differences(old, new):
    """The lines of new that old lacks."""
    known = set(old.splitlines())
    return [line for line in new.splitlines() if line not in known]


def main(arguments):
    comparisons = [argument for argument in arguments if argument != "--check"]
    old = README.read_text(encoding="utf-8")
    new = between(old, "rule", printed(rule.main))
    if comparisons:
        new = between(new, "findings", printed(findings.main, comparisons[0]))
    if new == old:
        print(f"{README.name}: the tables are those of the data")
    elif "--check" in arguments:
        print("\n".join(f"not in {README.name}: {line}" for line in differences(old, new)))
        sys.exit(f"error: {README.name} has other tables than the data; refresh them: python3 apps/study/tables.py")
    else:
        README.write_text(new, encoding="utf-8")
        print(f"{README.name}: refreshed")


if __name__ == "__main__":
    main(sys.argv[1:])
