# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of what is left at each landmark, a panel a patient."""

ACROSS, SIZE, EDGE = 4, 240, 24
LONGER = 5  # of the arrows, over the millimetres of the panel


def panel(row, case, left, top):
    """Seen from the left: back to front along x, upwards along y (LPS y and z)."""
    places = case["before"][:, 1:] * [-1, 1]
    ends = places + LONGER * case["error"][:, 1:] * [-1, 1]
    low, high = places.min(axis=0), places.max(axis=0)
    scale = (SIZE - 4 * EDGE) / max(high - low)

    def at(place):
        x, y = (place - low) * scale
        return f"{left + 2 * EDGE + x:.1f}", f"{top + SIZE - 2 * EDGE - y:.1f}"

    yield (f'<text x="{left + EDGE}" y="{top + EDGE - 6}">{row["patient"]}: model {row["model"]:.2f} mm, rigid '
           f'{row["rigid"]:.2f} mm</text>')
    yield (f'<rect x="{left + EDGE / 2}" y="{top + EDGE}" width="{SIZE - EDGE}" height="{SIZE - 1.5 * EDGE}" '
           'fill="none" stroke="#ccc"/>')
    for i, (place, end) in enumerate(zip(places, ends)):
        given = i in case["given"]
        (x, y), (u, v) = at(place), at(end)
        yield f'<line x1="{x}" y1="{y}" x2="{u}" y2="{v}" stroke="{"#888" if given else "#c33"}" stroke-width="1.5"/>'
        yield f'<circle cx="{x}" cy="{y}" r="2.5" fill="{"#888" if given else "#c33"}"/>'


def write_picture(file, rows, cases):
    down = -(-len(rows) // ACROSS)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{ACROSS * SIZE}" height="{down * SIZE + EDGE}" '
             'font-family="sans-serif" font-size="10">', '<rect width="100%" height="100%" fill="white"/>']
    for i, (row, case) in enumerate(zip(rows, cases)):
        lines += panel(row, case, i % ACROSS * SIZE, i // ACROSS * SIZE)
    lines.append(f'<text x="{EDGE}" y="{down * SIZE + 12}">Predicted minus measured, {LONGER} times as long as it is, '
                 'seen from the left. Red: predicted landmarks. Grey: the six that went in.</text></svg>')
    file.write_text("\n".join(lines) + "\n")
