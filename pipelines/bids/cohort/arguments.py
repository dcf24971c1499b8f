# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that brainshift-bids and brainshift-sweep share."""
import os

from . import engine, plan


def add_engine_options(parser):
    parser.add_argument("--jobs", "--n-cpus", "--n_cpus", type=int, metavar="N",
                        help="cores of this machine, or jobs at a time in a cluster's queue")
    parser.add_argument("--mem-mb", "--mem_mb", type=int, metavar="MB", help="memory of this machine for all jobs")
    parser.add_argument("--threads", type=int, metavar="N", help="of each job; the results do not depend on it")
    parser.add_argument("--profile", default="local", metavar="NAME",
                        help="local, slurm or a folder with Snakemake's config.yaml (%(default)s)")
    parser.add_argument("--one-job", action="store_true", help="all stages of a case in one job, not a job a stage")
    parser.add_argument("--dry-run", action="store_true", help="say what would be run, and stop")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="an option of all scenes, as discretise.nodes=6000 or solve.command='my_solver {in} {out}'")
    parser.add_argument("--brainshift", metavar="FILE", help="the program, if it is not on the path")
    parser.add_argument("--work-dir", "-w", metavar="DIR", help="for the runs; OUT/work if absent")
    parser.add_argument("--snakemake", action="append", default=[], metavar="WORD",
                        help="a further word to Snakemake, as --snakemake=--keep-incomplete")


def compute(options, work, cases, inputs, lock):
    """Runs the cases, each with its input files; Snakemake's exit code."""
    brainshift = engine.find_program(options.brainshift)
    stages = plan.WHOLE if options.one_job else plan.STAGES
    for case in cases:
        plan.write_case(work, case, inputs[case["name"]])
        plan.drop_marks(work / case["name"], stages)
    local = options.profile == "local"
    cores = (options.jobs if local else None) or len(os.sched_getaffinity(0))
    threads = options.threads or (max(1, cores // max(len(cases), 1)) if local else 1)
    plan.write_plan(work, cases, stages, brainshift, threads, cores)
    memory = options.mem_mb or (engine.memory_mb() if local else None)
    words = engine.snakemake(work, options.profile, cores if local else options.jobs, memory, options.dry_run,
                             options.snakemake)
    return engine.run(words, work, lock, engine.Progress(options.quiet or options.dry_run))
