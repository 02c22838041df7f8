#!/usr/bin/env python3
"""kept.py pack|unpack RUNS [SET...]: packs reduced runs into data/ beside this file, or unpacks what is kept there."""
import csv
import io
import json
import lzma
import pathlib
import sys
import tarfile

DATA = pathlib.Path(__file__).parent / "data"
TABLES = ("scalars", "flow")  # result files that become rows of one table; all others go into the archive of their set
COLUMNS = "set,run,vessel,D/d,D0/d,n,seed,sides,axis,grains,particle_steps,wall_seconds,commit"
STAMP = ".unpacked"  # in RUNS; runs that are newer than this file are not in data/ yet


def table_path(data, name):
    return pathlib.Path(data) / f"{name}.csv.xz"


def archive_path(data, set_name):
    return pathlib.Path(data) / f"{set_name}.tar.xz"


def read_lines(path):
    """The lines of a table, the heading first; none where there is no table."""
    if not path.exists():
        return []
    opened = lzma.open if path.suffix == ".xz" else open
    with opened(path, "rt", encoding="utf-8", newline="") as file:
        return file.read().splitlines()


def read_table(data, name):
    """The rows of runs.csv, or of one of TABLES, as dictionaries."""
    path = pathlib.Path(data) / "runs.csv" if name == "runs" else table_path(data, name)
    return csv.DictReader(read_lines(path))


def folders(runs, set_name):
    """The reduced runs of a set. Their summary is written last."""
    return sorted(summary.parent.parent for summary in pathlib.Path(runs).glob(f"{set_name}/*/results/summary.json"))


def is_table(path):
    return path.parent.name == "results" and path.suffix == ".csv" and path.stem in TABLES


def diameters(length, domain):
    """A length in grain diameters; empty where the vessel has none."""
    return "" if length is None else f"{length / domain['diameter_m']:.6g}"


def row_of(folder):
    """The row of runs.csv that is a run's."""
    summary = json.loads((folder / "results" / "summary.json").read_text(encoding="utf-8"))
    commit = json.loads((folder / "provenance.json").read_text(encoding="utf-8"))["git_describe"]
    domain, cost = summary["domain"], summary["cost"]
    kind, orifice = domain["kind"], domain["orifice_m"]
    vessel = "slot" if kind == "slot" else "pile" if orifice is None else "hopper"
    bounds = [domain["sides"], domain["axis"]] if kind == "sector" else ["", ""]
    cells = [folder.parent.name, folder.name, vessel, diameters(2 * domain["radius_m"], domain),
             diameters(orifice, domain), domain["order"], summary["seed"], *bounds, cost["grains"],
             f"{cost['particle_steps']:g}", f"{cost['wall_seconds']:g}", commit]
    return ",".join(map(str, cells))


def renewed(lines, heading, rows, sets):
    """A table as text: the rows of these sets are replaced, those of others stay."""
    others = [line for line in lines[1:] if line.split(",", 1)[0] not in sets]
    return "\n".join([heading] + sorted(others + rows, key=lambda row: row.split(",", 1)[0])) + "\n"


def pack_runs(runs, data, sets):
    rows = [row_of(folder) for name in sets for folder in folders(runs, name)]
    path = pathlib.Path(data) / "runs.csv"
    path.write_text(renewed(read_lines(path), COLUMNS, rows, sets), encoding="utf-8")


def pack_table(runs, data, sets, name):
    path = table_path(data, name)
    old, rows = read_lines(path), []
    heading = old[0] if old else ""
    for set_name in sets:
        for folder in folders(runs, set_name):
            lines = read_lines(folder / "results" / f"{name}.csv")
            rows += [f"{set_name},{folder.name},{line}" for line in lines[1:]]
            heading = f"set,run,{lines[0]}" if lines else heading
    path.write_bytes(lzma.compress(renewed(old, heading, rows, sets).encode()))


def pack_archive(runs, data, set_name):
    """All files of a set but the tables, without owners and times: the same files make the same archive."""
    with tarfile.open(archive_path(data, set_name), "w:xz", format=tarfile.USTAR_FORMAT) as archive:
        for folder in folders(runs, set_name):
            for path in sorted(p for p in folder.rglob("*") if p.is_file() and not is_table(p)):
                content = path.read_bytes()
                member = tarfile.TarInfo(path.relative_to(runs).as_posix())
                member.size = len(content)
                archive.addfile(member, io.BytesIO(content))


def pack(runs, data=DATA, sets=()):
    """Puts the sets, or all that RUNS has, into DATA; other sets there stay."""
    runs, data = pathlib.Path(runs), pathlib.Path(data)
    sets = [name for name in sets or sorted(p.name for p in runs.iterdir()) if folders(runs, name)]
    data.mkdir(parents=True, exist_ok=True)
    pack_runs(runs, data, sets)
    for name in TABLES:
        pack_table(runs, data, sets, name)
    for name in sets:
        pack_archive(runs, data, name)


def is_fresh(runs, data):
    """Whether all runs in DATA are in RUNS and none is newer there."""
    stamp = runs / STAMP
    if not stamp.exists() or any(path.stat().st_mtime > stamp.stat().st_mtime for path in data.glob("*")):
        return False
    kept = [runs / row["set"] / row["run"] for row in read_table(data, "runs")]
    return all((folder / "results" / "summary.json").exists() for folder in kept)


def put(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def unpack_table(runs, data, name):
    lines = read_lines(table_path(data, name))
    texts = {}
    for line in lines[1:]:
        set_name, run, rest = line.split(",", 2)
        texts.setdefault((set_name, run), [lines[0].split(",", 2)[2]]).append(rest)
    for (set_name, run), rows in texts.items():
        put(runs / set_name / run / "results" / f"{name}.csv", ("\n".join(rows) + "\n").encode())


def unpack_archive(runs, path):
    with tarfile.open(path, "r:xz") as archive:
        for member in archive:
            put(runs / member.name, archive.extractfile(member).read())


def unpack(runs, data=DATA):
    """Makes the folders of runs that DATA was packed from, unless they are there; other runs in RUNS stay."""
    runs, data = pathlib.Path(runs), pathlib.Path(data)
    if is_fresh(runs, data):
        return
    for name in TABLES:
        unpack_table(runs, data, name)
    for path in sorted(data.glob("*.tar.xz")):
        unpack_archive(runs, path)
    put(runs / STAMP, b"")


def main(arguments):
    if arguments[:1] == ["pack"] and len(arguments) > 1:
        pack(arguments[1], sets=arguments[2:])
    elif arguments[:1] == ["unpack"] and len(arguments) == 2:
        unpack(arguments[1])
    else:
        sys.exit("usage: python3 apps/study/kept.py pack RUNS [SET...] | unpack RUNS")


if __name__ == "__main__":
    main(sys.argv[1:])
