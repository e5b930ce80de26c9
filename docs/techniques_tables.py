#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the tables of docs/techniques-benchmark.md from folders that `limn bench techniques` wrote.

docs/techniques_tables.py NAME=FOLDER...      NAME: as the page calls the scene
"""
import json
import math
import sys

MIB = 1 << 20
SHORT = {"Illuminance composition": "illuminance", "Ambient": "ambient", "Light propagation volumes": "lpv",
         "Light field probes": "probes", "Sparse probes": "sparse", "Photon lattices": "photons",
         "LightSkin": "skin", "Dynamic radiance volumes": "volumes"}
SHOWN = {"Illuminance composition": "medium", "Light propagation volumes": "resolution 32",
         "Light field probes": "count 256", "Sparse probes": "medium", "Photon lattices": "photons 20000",
         "LightSkin": "vals 2048", "Dynamic radiance volumes": "read 32"}
# Bertilsson et al., Real-Time Global Illumination in Web-Browsers, 2018, tables 3 and 4: the frame on
# change less the idle frame [ms].
THESIS = {"Sponza": {"Light field probes": 8.92, "Sparse probes": 2.10, "Light propagation volumes": 3.69},
          "living room": {"Light field probes": 15.47, "Sparse probes": 2.31, "Light propagation volumes": 3.21}}


def device(row):
    return "CPU" if row["device"] == "cpu" else row["device"].split()[0]


def name(row):
    return f'{SHORT[row["technique"]]}, {row["settings"]}'.removesuffix(", defaults")


def milliseconds(value):
    if value is None:
        return "–"
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def percent(value):
    if value == 0:
        return "0 %"
    digits = max(0, 1 - math.floor(math.log10(abs(100 * value))))
    return f"{100 * value:.{digits}f} %"


def best_table(scenes, limits, unit, cost):
    print("| scene | on | " + " | ".join(f"{limit} {unit}" for limit in limits) + " |")
    print("|---|---|" + "---|" * len(limits))
    for scene, rows in scenes.items():
        label = scene
        for on in dict.fromkeys(device(r) for r in rows):
            cells = []
            for limit in limits:
                fitting = [r for r in rows if device(r) == on and cost(r) <= limit]
                best = min(fitting, key=lambda r: r["nrmse"], default=None)
                cells.append(f'{name(best)}: {best["nrmse"]:.2f}' if best else "none")
            shown = [c if i == 0 or c != cells[i - 1] else "″" for i, c in enumerate(cells)]
            print(f"| {label} | {on} | " + " | ".join(shown) + " |")
            label = ""


def shown_rows(scenes):
    """The rows of one setting of each technique, with the labels of their first two cells, "" where they repeat."""
    for scene, rows in scenes.items():
        label = scene
        for technique, settings in SHOWN.items():
            first = True
            for r in rows:
                if (r["technique"], r["settings"]) == (technique, settings):
                    yield label, name(r) if first else "", r
                    label, first = "", False


def change_table(scenes):
    print("| scene | technique | on | light | colour | material | camera | MiB | nRMSE | bias | "
          "device to CPU: rms, largest |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for label, technique, r in shown_rows(scenes):
        times = " | ".join(milliseconds(r[f"{kind}_ms"]) for kind in ("light", "color", "material", "camera"))
        away = ""
        if r["device"] != "cpu" and r.get("cpu_difference_rms") is not None:
            away = f'{percent(r["cpu_difference_rms"])}, {percent(r["cpu_difference_max"])}'
        print(f'| {label} | {technique} | {device(r)} | {times} | {r["bytes"] / MIB:.0f} | '
              f'{r["nrmse"]:.2f} | {100 * r["bias"]:+.0f} % | {away} |')


def object_table(scenes):
    columns = [(scene, on) for scene, rows in scenes.items() for on in dict.fromkeys(device(r) for r in rows)]
    print("| technique | " + " | ".join(f"{scene}, {on}" for scene, on in columns) + " |")
    print("|---|" + "---|" * len(columns))
    for technique, settings in SHOWN.items():
        found = {(scene, device(r)): r for scene, rows in scenes.items() for r in rows
                 if (r["technique"], r["settings"]) == (technique, settings)}
        if found:
            cells = [milliseconds(found[c]["object_ms"]) if c in found else "–" for c in columns]
            print(f"| {name(next(iter(found.values())))} | " + " | ".join(cells) + " |")


def live_table(scenes):
    print("| scene | technique | on | SSIM | FLIP | leak | flicker: lights, camera, objects | lag |")
    print("|---|---|---|---|---|---|---|---|")
    for label, technique, r in shown_rows(scenes):
        leak = "–" if r["leak"] is None else percent(r["leak"])
        flicker = ", ".join("–" if r.get(key) is None else f"{r[key]:+.3f}"
                            for key in ("flicker", "camera_flicker", "object_flicker"))
        lag = "–" if r["lag"] is None else r["lag"]
        print(f'| {label} | {technique} | {device(r)} | {r["ssim"]:.2f} | {r["flip"]:.2f} | '
              f"{leak} | {flicker} | {lag} |")


def thesis_table(scenes):
    order = ("Light field probes", "Sparse probes", "Light propagation volumes")
    print("| scene | | light field probes | sparse probes | light propagation volumes |")
    print("|---|---|---|---|---|")
    for scene, theirs in THESIS.items():
        if scene not in scenes:
            continue
        lines = [("thesis, GTX 780", theirs)]
        for on in dict.fromkeys(device(r) for r in scenes[scene]):
            lines.append((f"here, {on}", {r["technique"]: r["light_ms"] for r in scenes[scene]
                                          if device(r) == on and SHOWN.get(r["technique"]) == r["settings"]}))
        label = scene
        for what, ms in lines:
            ratios = [ms.get(t) and ms[t] / ms["Sparse probes"] for t in order]
            cells = ["–" if not r or r < 0.01 else "1" if t == "Sparse probes" else f"{r:.1f}"
                     for t, r in zip(order, ratios)]
            print(f"| {label} | {what} | " + " | ".join(cells) + " |")
            label = ""


def main():
    scenes = {}
    for argument in sys.argv[1:]:
        scene, _, folder = argument.partition("=")
        if not folder:
            sys.exit(__doc__)
        with open(f"{folder}/techniques.json", encoding="utf-8") as file:
            scenes[scene] = json.load(file)
    print("\nSmallest error at equal time\n")
    best_table(scenes, (2, 5, 10, 33, 100), "ms", lambda r: r["light_ms"])
    print("\nSmallest error at equal memory\n")
    best_table(scenes, (1, 4, 16, 64, 256), "MiB", lambda r: r["bytes"] / MIB)
    print("\nAll changes, and both devices\n")
    change_table(scenes)
    moving = {scene: rows for scene, rows in scenes.items() if any(r["object_ms"] is not None for r in rows)}
    if moving:
        print("\nAfter a moving object moved\n")
        object_table(moving)
    print("\nWhile light moves\n")
    live_table(scenes)
    print("\nBeside the thesis\n")
    thesis_table(scenes)


if __name__ == "__main__":
    main()
