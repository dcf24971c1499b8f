# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a group, and that of a case without a result."""
import html

from .measures import COLUMNS, COSTS, WARNINGS, doubtful_first, written

STYLE = ("body{font:15px sans-serif;margin:24px}table{border-collapse:collapse}td,th{padding:3px 9px;text-align:right;"
         "border-bottom:1px solid #ddd;white-space:nowrap}th{position:sticky;top:0;background:#fff}"
         "td:first-child,th:first-child,td.words{text-align:left}td.words{white-space:normal;min-width:24em}"
         ".far{background:#ffe08a}.warned{background:#fff6dd}.fault{background:#ffd4cf}")
MOST_ROWS = 2000  # a browser shows no more in a moment; the table holds all


def page(title, body):
    return (f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"/><title>{html.escape(title)}</title>'
            f"<style>{STYLE}</style>\n<h1>{html.escape(title)}</h1>\n{body}</html>\n")


def fault_page(name, sentence):
    return page(f"{name}: no result", f"<p>{html.escape(sentence)}</p>\n")


def shown(value):
    return f"{value:.3g}" if isinstance(value, float) and abs(value) < 1000 else written(
        round(value) if isinstance(value, float) else value)


def group_page(rows, far, table_name):
    order = doubtful_first(rows, far)
    done = sum(row["status"] == "done" for row in rows)
    out = sum(bool(places) for row, places in zip(rows, far) if row["status"] == "done")
    warned = sum(bool(row.get("warnings")) for row in rows)
    intro = (f"<p>{done} of {len(rows)} done, {warned} of them with warnings, of which the first is shown; {out} of "
             "them lie far from the others in the cells of a deeper colour. "
             f'The whole table: <a href="{table_name}">{table_name}</a>.</p>\n')
    if len(rows) > MOST_ROWS:
        intro += f"<p>The first {MOST_ROWS} rows are shown.</p>\n"
    names = [*WARNINGS, *COLUMNS, *COSTS]
    about = {name: text for name, (*_, text, _) in (COLUMNS | COSTS | WARNINGS).items()}
    head = "".join(f'<th title="{html.escape(about[name])}">{name}</th>' for name in names)
    lines = [row_text(rows[i], far[i], names) for i in order[:MOST_ROWS]]
    return page("brainshift: group", f"{intro}<table><tr><th>name</th>{head}</tr>\n" + "\n".join(lines) + "</table>\n")


def row_text(row, far, names):
    name = html.escape(row["name"])
    link = f'<td><a href="{name}.html">{name}</a></td>'
    if row["status"] != "done":
        sentence = html.escape(row["sentence"])
        return f'<tr class="fault">{link}<td class="words" colspan="{len(names)}">{sentence}</td></tr>'
    warning = f'<td class="words">{html.escape(row["first_warning"])}</td>' if row["warnings"] else "<td></td>"
    cells = "".join(warning if name == "first_warning" else
                    f'<td{" class=far" if name in far else ""}>{shown(row[name])}</td>' for name in names)
    return f'<tr{" class=warned" if row["warnings"] else ""}>{link}{cells}</tr>'
