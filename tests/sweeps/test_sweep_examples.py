"""The example files of the page: they are read by the programs that they are for."""

import runpy
import shutil
import subprocess
from pathlib import Path

import pytest

from softshadow.sweeps import read_specification

EXAMPLES = Path(__file__).parents[2] / "docs" / "sweeps"


def test_sweep_file_of_the_page_makes_its_points() -> None:
    points = read_specification(EXAMPLES / "sweep.toml").points()
    assert len(points) == (4 + 4 + 1) * 2 * 3


@pytest.mark.parametrize("name", ["class.sh", "slurm.sh"])
def test_script_has_no_mistake_in_its_syntax(name: str) -> None:
    bash = shutil.which("bash")
    if bash is None:
        pytest.skip("no bash")
    checked = subprocess.run([bash, "-n", str(EXAMPLES / name)], capture_output=True, text=True)
    assert (checked.returncode, checked.stderr) == (0, "")


@pytest.mark.slow
def test_slurm_job_starts_a_worker_process_with_one_thread_for_each_core() -> None:
    pytest.importorskip("dask_jobqueue")
    with runpy.run_path(str(EXAMPLES / "slurm.py"))["cluster"]() as cluster:
        script = cluster.job_script()
    assert "#SBATCH --cpus-per-task=16" in script
    assert "#SBATCH --mem=30G" in script
    assert " --nthreads 1 " in script
    assert " --nworkers 16 " in script
    checked = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True)
    assert (checked.returncode, checked.stderr) == (0, "")
