"""What ``softshadow compare`` prints and writes: tables, JSON, and pictures of the errors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from softshadow.cli.console import print_json, table

if TYPE_CHECKING:
    from softshadow.inspection.comparison import Comparison, ErrorSummary
    from softshadow.soft import Convergence, LawResult, TechniqueError

SPLIT = ("umbra", "penumbra", "lit")


def off_band(comparison: Comparison) -> ErrorSummary:
    """Return the error over all compared pixels but those of the band."""
    return comparison.part(comparison.compared & ~comparison.band)


def print_tables(
    title: str, results: Sequence[TechniqueError], fitted: Sequence[Convergence], measured: Sequence[LawResult],
    timed: bool,
) -> None:  # fmt: skip
    """Print the errors of one technique split by parts, or of several in a row each; then slopes and laws."""
    if len(results) == 1:
        table(f"{results[0].label} on {title}", ["pixels that are", "number", "max", "RMS", "wrong"], split(results[0]))
    else:
        table(title, *summary(results, timed))
    if fitted:
        rows = [[each.technique, each.pattern, f"{each.slope:.2f}"] for each in fitted]
        table("RMS error falls like samples to the power of", ["technique", "points", "slope"], rows)
    if measured:
        rows = [
            [each.technique, each.law.name, f"{each.before:.2f} -> {each.after:.2f}",
             f"{each.law.before.penumbra:.2f} -> {each.law.after.penumbra:.2f}",
             "holds" if each.holds else "direction only" if each.direction_holds else "no"]
            for each in measured
        ]  # fmt: skip
        table("laws of the penumbra: its width", ["technique", "law", "measured", "by the law", ""], rows)


def split(result: TechniqueError) -> list[list[str]]:
    """Return the errors of a technique split by the reference's shadow, as rows of a table."""
    parts = result.comparison.parts
    rows = {"compared": parts["all"], "off the band": off_band(result.comparison)}
    rows |= {name: parts[name] for name in SPLIT} | {"on the band": parts["band"]}
    return [
        [name, str(part.pixels), f"{part.max:.3f}", f"{part.rms:.4f}", str(part.wrong)] for name, part in rows.items()
    ]


def summary(results: Sequence[TechniqueError], timed: bool) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of a table with a row for each technique."""
    columns = ["technique", "s", "max", "RMS", "wrong", "wrong off band", *(f"RMS {name}" for name in SPLIT)]
    rows = []
    for each in results:
        parts = each.comparison.parts
        rows.append(
            [each.label, f"{each.seconds:.3f}", f"{parts['all'].max:.3f}", f"{parts['all'].rms:.4f}",
             str(parts["all"].wrong), str(off_band(each.comparison).wrong),
             *(f"{parts[name].rms:.4f}" for name in SPLIT)]
        )  # fmt: skip
    if not timed:
        columns, rows = [columns[0], *columns[2:]], [[row[0], *row[2:]] for row in rows]
    return columns, rows


def print_comparison_json(
    scene: str, size: tuple[int, int], truth: str | None, against: str, results: Sequence[TechniqueError],
    fitted: Sequence[Convergence], measured: Sequence[LawResult], exceeded: Sequence[str], written: Sequence[Path],
    output: str | None,
) -> None:  # fmt: skip
    """Print the comparison as JSON."""
    print_json(
        "compare", scene=scene, size=size, truth=None if truth is None else against, against=against, written=written,
        exceeded=exceeded, techniques=[_facts(each, timed=truth == "soft") for each in results],
        slopes=[{"technique": each.technique, "pattern": each.pattern, "slope": each.slope} for each in fitted],
        laws=[
            {"technique": each.technique, "law": each.law.name, "before": each.before, "after": each.after,
             "expected_before": each.law.before.penumbra, "expected_after": each.law.after.penumbra,
             "holds": each.holds}
            for each in measured
        ],
    )  # fmt: skip


def _facts(result: TechniqueError, timed: bool) -> dict[str, Any]:
    parts = result.comparison.parts | {"off_band": off_band(result.comparison)}
    return {
        "technique": result.technique,
        "options": result.options,
        "seconds": result.seconds if timed else None,
        "parts": {name: vars(part) for name, part in parts.items()},
    }


# -- files -------------------------------------------------------------------------------------------------------------
def check_output(output: str, force: bool) -> None:
    """Check before drawing that the output may be written."""
    from softshadow.inspection.files import is_folder, refuse_foreign

    if is_folder(output):
        return
    if Path(output).suffix.lower() not in (".png", ".html"):
        raise ValueError(f"{output}: expected an ending of .png or .html, or a folder (a path that ends in /)")
    refuse_foreign(Path(output), force)


def write(
    output: str, title: str, results: Sequence[TechniqueError], shown: Sequence[TechniqueError],
    fitted: Sequence[Convergence], force: bool,
) -> list[Path]:  # fmt: skip
    """Write the pictures of the errors, as one file or into a folder, and return the paths."""
    from softshadow.inspection.files import is_folder, write_whole
    from softshadow.inspection.pictures import save_png
    from softshadow.soft import contact_sheet_of, save_convergence_plot

    sheet = contact_sheet_of(shown)
    path = Path(output)
    if path.suffix.lower() == ".html":
        from softshadow.cli.compare_page import write_page

        tables = [(each.label, split(each)) for each in results]
        return [write_whole(path, lambda temporary: write_page(title, tables, sheet, temporary), force)]
    if not is_folder(output):
        return [write_whole(path, lambda temporary: save_png(sheet, temporary), force)]
    path.mkdir(parents=True, exist_ok=True)
    written = [write_whole(path / "errors.png", lambda temporary: save_png(sheet, temporary), force)]
    if fitted:
        plot = path / "slopes.svg"
        written.append(write_whole(plot, lambda temporary: save_convergence_plot(fitted, temporary), force))
    return written
