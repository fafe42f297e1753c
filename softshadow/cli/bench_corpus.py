"""``softshadow bench corpus``, ``features`` and ``small-draws``: GL programs and single features, here and on Mesa."""

from __future__ import annotations

import click

from softshadow.cli.console import CHECK_FAILED, print_json, say, table

CORPUS, FEATURES, SMALL = "corpus", "features", "small-draws"


def is_of_corpus(name: str) -> bool:
    """Return whether a name of `softshadow bench` is one of these families, or a program in one: "corpus/PROGRAM"."""
    return name.partition("/")[0] in (CORPUS, FEATURES, SMALL)


def bench_corpus(
    context: click.Context,
    names: tuple[str, ...],
    against: tuple[str, ...],
    threads: list[int],
    rounds: int,
    size: tuple[int, int] | None,
    as_json: bool,
) -> None:
    """Measure the programs and print the table; exit code 1 if a buffer differs."""
    from softshadow.bench.corpus.features import NAMES
    from softshadow.bench.corpus.measuring import measure
    from softshadow.bench.corpus.programs import PROGRAMS, SMALL_DRAWS, get
    from softshadow.bench.corpus.results import to_json
    from softshadow.bench.corpus.tables import program_rows, summary_lines
    from softshadow.testing.machine import machine

    if not all(map(is_of_corpus, names)):
        raise click.UsageError(
            "programs of the corpus, features and small draws are measured alone: expected corpus, corpus/PROGRAM, "
            "features, features/FEATURE+FEATURE, small-draws or small-draws/PROGRAM"
        )
    if against not in (("mesa",), ("llvmpipe",)):
        raise click.UsageError("the corpus is measured against llvmpipe: expected --against mesa")
    families = {CORPUS: tuple(PROGRAMS), FEATURES: NAMES, SMALL: tuple(SMALL_DRAWS)}
    chosen = [each for name in names for each in families.get(name, (name.removeprefix(f"{CORPUS}/"),))]
    programs = [get(name) for name in dict.fromkeys(chosen)]
    results = []
    for program in programs:
        for result in measure(program.resized(size) if size else program, threads, rounds):
            results.append(result)
            differing = "equal buffers" if result.equal else f"DIFFERING: {dict(result.differing)}"
            say(
                f"{result.name}, threads {result.threads}: {differing}; Mesa {result.mesa:.2f} ms, softshadow "
                f"{result.own:.2f} ms, ratio {result.ratio:.2f}; first frame {result.mesa_first:.0f} and "
                f"{result.own_first:.0f} ms"
            )
    results.sort(key=lambda result: threads.index(result.threads))
    if as_json:
        print_json("bench-corpus", machine=machine(with_mesa=True), rounds=rounds, **to_json(results))
    else:
        table("Corpus", *program_rows(results))
        for line in summary_lines(results):
            click.echo(line)
    if not all(result.equal for result in results):
        context.exit(CHECK_FAILED)
