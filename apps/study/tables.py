#!/usr/bin/env python3
"""tables.py [COMPARISONS] [--check]: puts the tables that rule.py (of runs/) and, of COMPARISONS, findings.py print into README.md
beside this file, between its markers. --check: writes nothing, exits with 1 where README.md says something else. Needs numpy."""
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


def main():
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    old = README.read_text()
    new = between(old, "rule", printed(rule.main, rule.RUNS))
    if arguments:
        new = between(new, "findings", printed(findings.main, arguments[0]))
    if new == old:
        print(f"{README.name}: the tables are those of the runs")
    elif "--check" in sys.argv:
        lines = set(old.splitlines())
        for line in new.splitlines():
            if line not in lines:
                print("not in README.md:", line)
        sys.exit(f"error: {README.name} has other tables than the runs; refresh them: python3 apps/study/tables.py")
    else:
        README.write_text(new)
        print(f"{README.name}: refreshed")


if __name__ == "__main__":
    main()
