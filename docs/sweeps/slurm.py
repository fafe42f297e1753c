"""A sweep on Slurm: 8 jobs with 16 worker processes each. Run it on a login node (pip install dask-jobqueue)."""

from dask_jobqueue import SLURMCluster

import softshadow as ss


def cluster() -> SLURMCluster:
    """Return a cluster without jobs; `job_script()` shows what will be submitted."""
    return SLURMCluster(
        cores=16,
        processes=16,  # one kernel thread each
        memory="32GB",
        walltime="02:00:00",
        job_extra_directives=["--job-name=softshadow"],
        job_script_prologue=["export OPENBLAS_NUM_THREADS=1", "export NUMBA_CACHE_DIR=$HOME/.cache/softshadow-slurm"],
    )


if __name__ == "__main__":
    with cluster() as jobs:
        jobs.scale(jobs=8)
        table = ss.sweep("sweep.toml", "sweep.csv", scheduler=jobs.scheduler_address)
        print(table)
