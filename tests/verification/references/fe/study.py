"""One problem on meshes of several sizes: the finest answer with the comment lines that say how far it has converged."""
from . import tables


def converged(name, element, levels, solve, sample, figure, figure_is="force"):
    """The finest sample of the displacement, and the comment lines on mesh and error.

    solve(cells) gives (mesh, solution), sample(mesh, field) the displacement at the sample points and
    figure(solution, field) the one number whose convergence is said beside the displacement's; figure_is names it.
    """
    samples, figures = [], []
    for cells in levels:
        mesh, solution = solve(cells)
        field = solution.fields[1.0]
        samples.append(sample(mesh, field))
        figures.append(figure(solution, field))
        print(f"{name}: {len(mesh.elements)} {element}, reached {solution.reached}, {figure_is} {figures[-1]:.6f}, "
              f"{solution.seconds:.0f} s", flush=True)
    force, lengths, lines = tables.convergence(figures, samples, levels)
    in_place = "" if figure_is == "force" else f"; in place of a force the lines below have the {figure_is}"
    return samples[-1], [f"made by fe/{name}.py with {tables.versions()}",
                         f"finest mesh: {len(mesh.elements)} {element} on {len(mesh.nodes)} nodes{in_place}",
                         *lines, tables.error_line(force, lengths)]
