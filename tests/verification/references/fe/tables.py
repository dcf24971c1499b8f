"""The reference files: comment lines that say what a file is and how good, then rows."""
import re
import subprocess

import numpy as np


def program_version(command):
    said = subprocess.run(command, capture_output=True, text=True, check=False)
    found = re.search(r"\d+\.\d+(\.\d+)?", said.stdout + said.stderr)
    return found[0] if found else "unknown"


def versions(with_gmsh=False):
    made = "ccx " + program_version(["ccx", "-v"])
    return (f"gmsh {program_version(['gmsh', '--version'])}, " if with_gmsh else "gmsh not used (structured mesh by the script), ") + made


def differences(coarse, fine):
    """Largest, 95 % and mean length of the difference of two displacement samples, mm."""
    lengths = np.linalg.norm(coarse - fine, axis=1)
    return lengths.max(), np.percentile(lengths, 95), lengths.mean()


def error_line(force_percent, lengths):
    return (f"error: force_percent={force_percent:.3g} largest_mm={lengths[0]:.3g} p95_mm={lengths[1]:.3g} "
            f"mean_mm={lengths[2]:.3g}")


def row_ranges(groups):
    """Comment that says which rows (from 1) hold which named group of samples, in the order of the groups."""
    ends = np.cumsum([len(points) for points in groups.values()])
    return "rows: " + "; ".join(f"{end - len(points) + 1}-{end} {name}" for (name, points), end in zip(groups.items(), ends))


def write_samples(path, comments, points, displacements):
    write(path, comments, "x,y,z,ux,uy,uz", np.hstack([points, displacements]), "%.4f")


def write_curve(path, comments, rows, columns="displacement_mm,force_N"):
    write(path, comments, columns, np.asarray(rows), "%.7g")


def write(path, comments, columns, rows, number):
    with open(path, "w") as table:
        table.writelines(f"# {line}\n" for line in comments)
        table.write(columns + "\n")
        np.savetxt(table, rows + 0.0, fmt=number, delimiter=",")


def convergence(forces, samples, sizes):
    """Own error of the finest of several meshes: (force in %, lengths in mm, comment lines).

    `sizes` are cell counts along a length. Richardson: what is left in the finest mesh is its change from the coarsest times
    1 / (ratio^rate - 1), for the force with its own rate, for the displacement with that of the mean difference, over the
    last three meshes and kept between 0.5 and 2 (1 where there are only two meshes). The largest difference sits at one
    singular place and has no steady rate: what is left of it counts as no less than its last change.
    """
    changes = np.array([differences(a, b) for a, b in zip(samples, samples[1:])])
    rates = [observed_rate(np.abs(np.diff(forces)), sizes), observed_rate(changes[:, 2], sizes)]
    left_over = 1 / ((sizes[-1] / sizes[-2 if len(sizes) < 3 else -3]) ** np.array(rates) - 1)
    first = max(len(forces) - 3, 0)
    limit = forces[-1] + (forces[-1] - forces[first]) * left_over[0]
    lengths = np.array(differences(samples[first], samples[-1])) * left_over[1]
    lengths[0] = max(lengths[0], changes[-1, 0])
    lines = [f"meshes {', '.join(map(str, sizes))} cells along: force {', '.join(f'{f:.6g}' for f in forces)}; "
             f"last change {100 * (forces[-1] / forces[-2] - 1):+.4f} %; converged by Richardson {limit:.6g}"]
    lines += [f"change of the samples from {a} to {b} cells: largest {c[0]:.4f}, 95 % {c[1]:.4f}, mean {c[2]:.4f} mm"
              for a, b, c in zip(sizes, sizes[1:], changes)]
    lines.append("the error line is Richardson's estimate of what is left in the finest mesh, with rates "
                 f"{rates[0]:.2f} (force) and {rates[1]:.2f} (displacement); largest: no less than the last change")
    lines.append(f"converged_force: {limit:.6g}")
    return 100 * abs(limit / forces[-1] - 1), lengths, lines


def observed_rate(changes, sizes):
    """p for which the changes over the last three meshes are those of c size^-p."""
    if len(changes) < 2:
        return 1.0
    n = np.array(sizes[-3:], float)
    rates = np.linspace(0.5, 2, 151)
    ratios = (n[0] ** -rates - n[1] ** -rates) / (n[1] ** -rates - n[2] ** -rates)
    return float(rates[np.argmin(np.abs(ratios - changes[-2] / changes[-1]))])


def read(path):
    """Rows of a table without its comment and title lines."""
    return np.loadtxt(path, delimiter=",", skiprows=1 + comment_count(path))


def comment_count(path):
    with open(path) as table:
        return sum(line.startswith("#") for line in table)
