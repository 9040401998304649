#!/usr/bin/env python3
"""Writes the page that holds stated errors and forecasts to measured ones: page.py CHECK.csv > RESULTS.md

Under: the measured error is at most the other, or its distance is within the reference's noise (one standard error).
Loose: the other over measured, where the measured error is more than its own noise.
"""
import csv
import sys

RUNGS = ["additive", "harris", "single", "transport-16", "transport-24", "transport-32", "transport-48", "transport-64"]


def read(path):
    with open(path) as file:
        return [r for r in csv.DictReader(file) if r["rung"] in RUNGS]


def number(row, name):
    return float(row[name])


def percent(value):
    return f"{100 * value:.3g}%"


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2] if ordered else float("nan")


def quantile(values, share):
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)] if ordered else float("nan")


def under(row, column="stated"):
    return number(row, "error") - number(row, "error_noise") <= number(row, column)


def strictly_under(row, column="stated"):
    return number(row, "error") <= number(row, column)


def seen(row):
    return number(row, "error") > number(row, "error_noise")


def looseness(row, column="stated"):
    return number(row, column) / number(row, "error")


def summary(rows, column):
    word = "stated" if column == "stated" else "forecast"
    print(f"| rung | scenes | under | under, noise aside | measured above noise | {word} / measured: median | 10% to 90% | measured: median | largest |")
    print("|---|---|---|---|---|---|---|---|---|")
    for rung in RUNGS + ["all"]:
        mine = [r for r in rows if rung in ("all", r["rung"])]
        loose = [looseness(r, column) for r in mine if seen(r)]
        errors = [number(r, "error") for r in mine]
        print(f"| {rung} | {len(mine)} | {percent(sum(strictly_under(r, column) for r in mine) / len(mine))} "
              f"| {percent(sum(under(r, column) for r in mine) / len(mine))} | {len(loose)} | {median(loose):.2f} "
              f"| {quantile(loose, .1):.2f} to {quantile(loose, .9):.2f} | {percent(median(errors))} | {percent(max(errors))} |")
    print()


def scenes(rows):
    print("| scene | particles | depth | g | albedo | sun cosine | " + " | ".join(RUNGS) + " |")
    print("|---" * (6 + len(RUNGS)) + "|")
    by_scene = {}
    for row in rows:
        by_scene.setdefault((row["set"], int(row["index"])), {})[row["rung"]] = row
    for key in sorted(by_scene):
        mine, index = by_scene[key], f"{key[0]} {key[1]}"
        any_row = next(iter(mine.values()))
        cells = []
        for rung in RUNGS:
            row = mine.get(rung)
            if not row:
                cells.append("")
                continue
            shown = percent(number(row, "error")) if seen(row) else f"< {percent(number(row, 'error_noise'))}"
            mark = "" if under(row) else " **over**"
            cells.append(f"{shown} / {percent(number(row, 'stated'))}{mark}")
        print(f"| {index} {any_row['kind']} | {any_row['particles']} | {number(any_row, 'depth_eye'):.3g} | {any_row['g']} "
              f"| {any_row['albedo']} | {number(any_row, 'sun_cosine'):.2f} | " + " | ".join(cells) + " |")
    print()


check = read(sys.argv[1])
print("""# How far the errors that are stated can be trusted

Made by the commands of [README.md](README.md); not written by hand. Errors are nRMSE against the path tracer, noise
corrected (`core/accuracy/error_measures.h`), of pictures of 80 x 60 pixels, on scenes to which no forecast was fitted. What
is stated of a picture was measured while it was made (`core/climb.h`), without the path tracer; three constants in it were
settled after a look at 36 of these scenes.

Under: the measured error is at most the stated one. "Noise aside": or above it by no more than one standard error of the
reference. Stated / measured is over scenes where the error stands out of the reference's noise.
""")
summary(check, "stated")
print("""## Forecasts

What plans expect before anything is measured, from the survey's figures alone.
""")
summary(check, "predicted_error")
print("## Every scene: measured / stated\n")
scenes(check)
