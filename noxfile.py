"""The commands of CONTRIBUTING.md by name: `uv run --group tools nox -l` lists them; .ci/run uses them too."""

import os
import shutil
import tarfile
import tempfile
from pathlib import Path

import nox

ROOT = Path(__file__).parent
IN_THE_SDIST = (  # what the tests read, besides the package and themselves
    "README.md", "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff", "LICENSE", "constraints.txt", "pyproject.toml",
    "benchmarks/baseline.json", "docs/conf.py", "tests/conftest.py", ".ci/constraints",
)  # fmt: skip

nox.options.default_venv_backend = "none"  # uv run has made the environment
nox.options.sessions = ["lint", "types", "floors", "tests"]


@nox.session
def lint(session: nox.Session) -> None:
    """Check style and format."""
    session.run("ruff", "check")
    session.run("ruff", "format", "--check")


@nox.session
def types(session: nox.Session) -> None:
    """Check the types of the package and of the tests."""
    session.run("mypy")


@nox.session
def floors(session: nox.Session) -> None:
    """Check that imports go down the floors and in no circle."""
    session.run("lint-imports")


@nox.session
def tests(session: nox.Session) -> None:
    """Run the quick lane of the tests, or what is named after --."""
    session.run("pytest", *session.posargs)


@nox.session
def long(session: nox.Session) -> None:
    """Run all tests, with many more random programs."""
    session.run("pytest", *session.posargs, env={"SOFTSHADOW_LANE": "all"})


@nox.session
def bounds(session: nox.Session) -> None:
    """Run random programs with kernels that check every index, compiled into a cache folder of their own."""
    folder = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "softshadow-bounds-checked"
    checks = {"NUMBA_BOUNDSCHECK": "1", "NUMBA_CACHE_DIR": str(folder), "SOFTSHADOW_LANE": "all"}
    files = session.posargs or ["tests/bounds", "tests/mesa/test_random_programs.py", "tests/recordings"]
    session.run("pytest", *files, env=checks)


@nox.session
def interpreted(session: nox.Session) -> None:
    """Run the kernels as plain Python."""
    session.run("pytest", "-q", "-m", "interpreted", *session.posargs, env={"NUMBA_DISABLE_JIT": "1"})


@nox.session
def coverage(session: nox.Session) -> None:
    """Run the kernels as plain Python, in three times the time, and report the lines that no test reached."""
    data = {"COVERAGE_FILE": os.path.join(session.create_tmp(), "coverage")}
    session.run("coverage", "erase", env=data)
    environment = {"NUMBA_DISABLE_JIT": "1", **data}
    session.run("coverage", "run", "-m", "pytest", "-q", "-m", "interpreted", *session.posargs, env=environment)
    session.run("coverage", "combine", "--quiet", env=data)
    session.run("coverage", "report", env=data)


@nox.session
def docs(session: nox.Session) -> None:
    """Build the documentation, in which a warning is an error, and open pages in a browser."""
    folder = session.posargs[0] if session.posargs else "docs/_build/html"
    session.run("sphinx-build", "-q", "-W", "--keep-going", "-j", "auto", "-b", "html", "docs", folder)
    site = {"SOFTSHADOW_SITE": os.path.abspath(folder)}
    session.run("pytest", "-q", "-n0", "tests/docs/test_site_in_browser.py", env=site)
    # Sphinx and the executed pages leave nothing in the tree
    left = session.run("git", "status", "--porcelain", "docs", external=True, silent=True) or ""
    if new := [line for line in left.splitlines() if line.startswith("??")]:
        session.error(f"the build left {', '.join(new)}")


@nox.session
def links(session: nox.Session) -> None:
    """Ask for every link of the documentation to another site; needs the network, so .ci/run leaves it out."""
    with tempfile.TemporaryDirectory() as folder:
        quiet = ("-D", "nb_execution_mode=off", "-D", "suppress_warnings=myst-nb.lexer")  # no cell runs
        session.run("sphinx-build", "-q", "-b", "linkcheck", *quiet, "docs", folder)


@nox.session
def package(session: nox.Session) -> None:
    """Build sdist and wheel, install the wheel and use it outside the checkout."""
    uv = os.environ.get("UV") or shutil.which("uv") or str(ROOT / ".tools" / "bin" / "uv")
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        session.run(uv, "build", "--quiet", "--out-dir", folder)  # the wheel is built from the sdist
        (sdist,), (wheel,) = work.glob("*.tar.gz"), work.glob("*.whl")
        with tarfile.open(sdist) as archive:
            names = {name.partition("/")[2] for name in archive.getnames()}
        if missing := [name for name in IN_THE_SDIST if name not in names]:
            session.error(f"the sdist has no {', '.join(missing)}")
        kernels = os.environ.get("NUMBA_CACHE_DIR", f"{folder}/kernels")
        environment = {"VIRTUAL_ENV": f"{folder}/installed", "PYTHONPATH": "", "NUMBA_CACHE_DIR": kernels}
        session.run(uv, "venv", "--quiet", f"{folder}/installed")
        session.run(uv, "pip", "install", "--quiet", "-c", "constraints.txt", str(wheel), env=environment)
        bin = "Scripts" if os.name == "nt" else "bin"
        python, softshadow = (f"{folder}/installed/{bin}/{name}" for name in ("python", "softshadow"))
        (work / "elsewhere").mkdir()
        with session.chdir(work / "elsewhere"):
            where = "import softshadow; assert 'site-packages' in softshadow.__file__, softshadow.__file__"
            session.run(python, "-c", where, env=environment)
            session.run(softshadow, "--help", env=environment, silent=True)
            session.run(softshadow, "lessons", "lessons", "--no-start", env=environment, silent=True)
            session.run(softshadow, "tour", "-o", "tour", env=environment, silent=True)
            session.run(softshadow, "render", "volume-zfail", "--scene", "torus", "-o", "x.png", env=environment)
            for written in ("tour/index.html", "x.png", "lessons/05_stencil_buffer.py"):
                if not Path(written).stat().st_size:
                    session.error(f"{written} is empty")
