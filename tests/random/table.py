# SPDX-License-Identifier: GPL-3.0-or-later
"""problems.csv as a page: what was judged load by load, and the worst cases."""
import statistics


def number(row, name):
    try:
        return float(row.get(name, ""))
    except (TypeError, ValueError):
        return None


def ratios(rows, above, below):
    pairs = [(number(r, above), number(r, below)) for r in rows]
    return [a / b for a, b in pairs if a is not None and b]


def shown(values, pick):
    return f"{pick(values):.2g}" if values else ""


def line(cells):
    return "| " + " | ".join(str(c) for c in cells) + " |"


def by_load(rows):
    lines = [line(("load", "problems", "converged", "not solved, as the reference", "good",
                   "95 % error, % of the largest: median; worst", "error over estimate: median; worst",
                   "distance over bound: worst", "imbalance, %: worst")), line(["---"] * 9)]
    groups = {}
    for row in rows:
        groups.setdefault(row["load"].split()[0] + (", with a rim" if row["rim"] == "1" else ""), []).append(row)
    for load, group in sorted(groups.items()) + [("all", rows)]:
        errors = [100 * e for e in ratios(group, "error_95", "moved")]
        over = ratios(group, "error_95", "estimate_95")
        bound = ratios(group, "off_by", "bound")
        balance = [100 * b for b in (number(r, "balance") for r in group) if b is not None]
        lines.append(line((load, len(group), sum(r["exit"] == "0" for r in group),
                           sum(r["verdict"] == "neither solves" for r in group),
                           sum(r["verdict"] == "good" for r in group),
                           f"{shown(errors, statistics.median)}; {shown(errors, max)}",
                           f"{shown(over, statistics.median)}; {shown(over, max)}", shown(bound, max),
                           shown(balance, max))))
    return lines


def share(values, low, high):
    return f"{sum(low <= v <= high for v in values)} of {len(values)}" if values else "none"


def tightness(rows):
    """How far bounds and estimates are above what they stand for."""
    bounds, estimates = ratios(rows, "bound", "off_by"), ratios(rows, "estimate_95", "error_95")
    return ["", f"The bound over the distance: median {shown(bounds, statistics.median)}, at most 10 in "
                f"{share(bounds, 0, 10)}. The estimate over the error: 0.5 to 5 in {share(estimates, 0.5, 5)}."]


def worst(rows, above, below, title, count=8):
    known = [(a / b, r) for r in rows for a, b in [(number(r, above), number(r, below))] if a is not None and b]
    lines = ["", f"## {title}", line(("ratio", "seed", "body", "cloud; cells; basis", "tissues: E over the least, nu",
                                      "load", "reference", "steps")), line(["---"] * 8)]
    for ratio, r in sorted(known, key=lambda pair: -pair[0])[:count]:
        lines.append(line((f"{ratio:.2g}", r["seed"], r["body"], f"{r['cloud']}; {r['cells']}; {r['basis']}",
                           r["tissues"], r["load"], r["reference"], r["steps"])))
    return lines


def page(rows):
    lines = ["# Random problems", ""] + by_load(rows) + tightness(rows)
    bad = [r for r in rows if r["verdict"] != "good"]
    lines += ["", "## Not good", line(("seed", "verdict", "body", "cloud; cells; basis", "tissues", "load", "says")),
              line(["---"] * 7)]
    lines += [line((r["seed"], r["verdict"], r["body"], f"{r['cloud']}; {r['cells']}; {r['basis']}", r["tissues"],
                    r["load"], r["says"][:160])) for r in bad]
    lines += worst(rows, "error_95", "estimate_95", "Farthest beyond the estimate")
    lines += worst(rows, "error_95", "moved", "Farthest from the reference")
    lines += worst(rows, "off_by", "bound", "Farthest beyond the bound")
    return "\n".join(lines) + "\n"
