# synthetic_run.py FOLDER ANGLE SEED [WIDTH [ORIFICE [ARCHED]]]: the result files of a hopper (a sandpile with orifice 0) that was never run, with
# known numbers: the test of `wedge report` makes its runs with it. In them cn = 4 + seed / 10, discharge_rate = 1000 + 10 seed (less for sectors).
import json
import math
import os
import random
import sys

folder, angle, seed = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
width = float(sys.argv[4]) if len(sys.argv) > 4 else 12.0
orifice = float(sys.argv[5]) if len(sys.argv) > 5 else 4.0
arched = int(sys.argv[6]) if len(sys.argv) > 6 else 0
d, order, height = 0.005, round(360 / angle), 12
full = order == 1
moments = [("settle", "instant", 0.5, 0.5, 1), ("open", "instant", 1.2, 1.2, 1), ("flow_mean", "mean", 1.2, 2.0, 17)]
if not orifice:
    moments = [("settle", "instant", 0.5, 0.5, 1), ("collapse", "instant", 0.64, 0.64, 1), ("spread", "instant", 0.86, 0.86, 1),
               ("pile", "instant", 2.0, 2.0, 1)]


def of_stage(moment):
    stage = moment.removesuffix("_mean")
    still = stage in ("settle", "pile")
    return {"stage": stage, "role": "rest" if still else "flow", "walls": ["shell", "floor"] + (["plug"] if stage == "settle" else [])}


instants = [m[0] for m in moments if m[1] == "instant"]
number = random.Random(seed * 1000 + order)
results = os.path.join(folder, "results")
os.makedirs(results, exist_ok=True)


def write(name, head, rows):
    with open(os.path.join(results, name), "w") as file:
        file.write(head + "\n" + "".join(",".join(str(cell) for cell in row) + "\n" for row in rows))


def scalars():
    loss = 0.1 * (1 - angle / 360)
    return {"grains": (1200, "-"), "packing": (0.55 + 0.001 * seed, "-"), "cn": (4 + seed / 10, "-"), "cn0": (4.5, "-"), "load": (0.04, "N"),
            "speed": (0.05, "m/s"), "axis_density_1d": (1 + loss, "-"), "axis_density_2d": (1 + loss / 2, "-"),
            "cn_slope": (0.4, "-"), "cn_intercept": (2.7, "-"), "cn_slope_paper": (0.5, "-"), "cn_intercept_paper": (2.5, "-"),
            "discharge_rate": ((1000 + 10 * seed) * (1 - loss), "1/s"), "arched": (arched, "-"), "beverloo_low": (900, "1/s"),
            "beverloo_high": (1200, "1/s"), "angle_of_repose": (30 + seed, "deg")}


def counts(first, last, centre, spread):
    return " ".join(f"{1000 * math.exp(-((k - centre) / spread) ** 2) * number.uniform(0.9, 1.1):.4g}" for k in range(first, last))


names = [m[0] for m in moments]
write("scalars.csv", "moment,part,quantity,unit,value,low,high",
      [(m, "whole", q, unit, value, "nan", "nan") for m in names for q, (value, unit) in scalars().items()])
rows = [(m, "whole", "all", "cn", "-", 1, 0, 0, counts(0, 10, 4, 2)) for m in names]
rows += [(m, "whole", "all", q, "m/s", 0.01 * math.sqrt(9.81 * d), 0.1, -40, counts(-40, 40, 0, 12)) for m in names for q in ("vr", "vt", "vz")]
rows += [(m, "whole", "all", q, "N", 0.00244, 0.1, -40, counts(-40, 40, 0, 12)) for m in names for q in ("fr", "ft", "fz", "load")]
write("distributions.csv", "moment,part,region,quantity,unit,scale,step,first,counts", rows)
write("radial.csv", "moment,part,r [m],arc [d],grains,cn,cn_near,cn_distinct,cn_corrected,vr [m/s],vt [m/s],vz [m/s],speed_spread [m/s]",
      [(m, "whole", (k + 0.5) * d / 2, (k + 0.5) / 2 * math.radians(angle), 20 * (k + 0.5), 4.5, 5, 4.2, 4.5, 0, 0, -0.05, 0.01)
       for m in names for k in range(int(width))])
write("map.csv", "moment,part,r [m],z [m],grains,packing,cn,cn_near,cn_distinct,cn_corrected,vr [m/s],vt [m/s],vz [m/s],prr [Pa],ptt [Pa],pzz [Pa],"
      "prz [Pa],zone", [(m, "whole", (i + 0.5) * d, (2 * k + 1) * d, 10, 0.55, 4 + 0.1 * i, 5, 4, 4, 0, 0, -0.01 * (k + 1), 200, 200, 300, 0, 1 + k % 3)
                        for m in names for i in range(int(width / 2)) for k in range(height // 2)])
left = 0 if not full else -width / 2
grains = [(number.uniform(left, width / 2) * d, number.uniform(-2, 2) * d, number.uniform(0, height) * d) for _ in range(400)]
write("slice.csv", "moment,x [m],y [m],z [m],radius [m],cn,vr [m/s],vz [m/s],layer",
      [(m, *g, d / 2, 4, 0, -0.05, int(g[2] / d)) for m in instants for g in grains])
write("network.csv", "moment,x1 [m],z1 [m],x2 [m],z2 [m],load [N]",
      [(m, g[0], g[2], g[0] + d / 2, g[2] + d / 2, 0.04) for m in instants for g in grains])
around = [(number.uniform(1, width / 2) * d, math.radians(number.uniform(0, angle))) for _ in range(60)]
write("cut.csv", "moment,x [m],y [m],z [m],radius [m],cn,vz [m/s],layer",
      [(m, r * math.cos(a), r * math.sin(a), 5 * d, d / 2, 4, -0.05, 3) for m in instants for r, a in around])
write("flow.csv", "time [s],out,rate [1/s]", [(0.05 * k, 50 * k, 1000 if k else "nan") for k in range(31)])

domain = {"kind": "full" if full else "sector", "angle_deg": angle, "order": order, "sides": "periodic", "axis": "clamp", "diameter_m": d,
          "radius_m": width / 2 * d, "orifice_m": orifice * d or None}
cost = {"grains": 1200 // order, "steps": 1000, "wall_seconds": 100.0 / order, "threads": 1, "particle_steps_per_second": 1.2e7, "precision": "mixed"}
summary = {"domain": domain, "cost": cost, "seed": seed,
           "moments": [dict(zip(("name", "kind", "begin_s", "end_s", "frames"), m), **of_stage(m[0])) for m in moments],
           "scalars": {m: {q: {"value": v, "low": None, "high": None, "unit": u} for q, (v, u) in scalars().items()} for m in names}}
with open(os.path.join(results, "summary.json"), "w") as file:
    json.dump(summary, file)
with open(os.path.join(folder, "provenance.json"), "w") as file:
    json.dump({"version": "0.1.0", "git_describe": "abc1234", "precision": "mixed", "threads": 1, "processor": "made up",
               "command_line": ["wedge", "run", "hopper.toml", "-o", os.path.basename(folder), "--set", f"domain.angle={angle:g}"]}, file)
half = width / 2 * d
closed = f"[0.0, 0.0], [{orifice / 2 * d}, 0.0]" if orifice else f"[{0.8 * half}, 0.0], [{half}, 0.0]"
floor = f"[{orifice / 2 * d}, 0.0], [{half}, 0.0]" if orifice else f"[0.0, 0.0], [{0.8 * half}, 0.0]"
with open(os.path.join(folder, "scene.resolved.toml"), "w") as file:
    file.write(f"""[domain]
kind = "{domain['kind']}"
angle = {angle}
gravity = [0.0, 0.0, -9.81]
outlet = {{ z = -0.05 }}

[[wall]]
name = "shell"
profile = [[{half}, 0.0], [{half}, {2 * height * d}]]

[[wall]]
name = "floor"
profile = [{floor}]

[[wall]]
name = "plug"
profile = [{closed}]

[material.grain]
density = 3800.0

[contact."grain-grain"]
sliding = 0.6
rolling = 1e-04

[particles]
diameter = {d}
material = "grain"
count = 1200
seed = {seed}

[contact."grain-wall"]
sliding = 0.5
rolling = 1e-04
""")
    for number, name in enumerate(("settle", "open", "flow") if orifice else ("settle", "collapse", "spread", "pile")):
        removed = '["plug"]' if number == 1 else "[]"
        file.write(f'\n[[stage]]\nname = "{name}"\nremove = {removed}\n')
