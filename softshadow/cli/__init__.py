"""The command line: ``softshadow COMMAND``. Results go to stdout, messages to stderr.

Exit codes: 0 success, 1 a check failed, 2 wrong usage (a word of the command line), 3 bad input (a file, a folder, a
scene that the technique cannot draw), 130 interrupted, 143 ended by SIGTERM. Modules that are slow to import are
imported inside the commands, so that ``--help`` is fast.
"""

from __future__ import annotations

import errno
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

import softshadow
from softshadow.cli.animate import animate
from softshadow.cli.arguments import examples
from softshadow.cli.bench import bench
from softshadow.cli.cards import cards
from softshadow.cli.check import check
from softshadow.cli.compare import compare
from softshadow.cli.console import say, say_marked
from softshadow.cli.errata import errata
from softshadow.cli.exports import export, view3d
from softshadow.cli.failures import failures
from softshadow.cli.lessons import lessons
from softshadow.cli.listings import listings
from softshadow.cli.lists import scenes, techniques
from softshadow.cli.machine import doctor, warmup
from softshadow.cli.replay import replay
from softshadow.cli.runs import pixel, render, section, steps
from softshadow.cli.script import run
from softshadow.cli.slides import slides
from softshadow.cli.sweeps import sweep
from softshadow.cli.tours import tour
from softshadow.errors import SoftShadowError

WRONG_USAGE, BAD_INPUT, INTERRUPTED, TERMINATED = 2, 3, 130, 143
OPTION_NAMES = {"force=True": "--force"}  # Python arguments in error messages, and the options they correspond to


class InputError(click.ClickException):
    """Bad input, reported in one line."""

    exit_code = BAD_INPUT

    def show(self, file: Any = None) -> None:
        """Print the message."""
        say_marked("error", self.message)


class UsageError(InputError):
    """Wrong usage, reported with the command whose help explains it."""

    exit_code = WRONG_USAGE

    def __init__(self, message: str, command: str) -> None:
        super().__init__(message)
        self.command = command

    def show(self, file: Any = None) -> None:
        """Print the message."""
        super().show(file)
        say(f"help: {self.command} --help")


class CommandGroup(click.Group):
    """The group of all commands; errors caused by the user become one line and an exit code."""

    def make_context(self, info_name: str | None, args: list[str], *more: Any, **extra: Any) -> click.Context:
        """Read the arguments before the command."""
        try:
            return super().make_context(info_name, args, *more, **extra)
        except click.exceptions.NoArgsIsHelpError:
            raise
        except click.UsageError as error:
            raise UsageError(error.format_message(), info_name or "softshadow") from None

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; print errors of its arguments and of this package as one line, with their exit code."""
        try:
            with exit_on_sigterm():
                return super().invoke(ctx)
        except click.UsageError as error:
            command = error.ctx.command_path if error.ctx else _command_path(ctx)
            raise UsageError(error.format_message(), command) from None
        except (SoftShadowError, ValueError, TypeError, OSError, MemoryError) as error:
            # EPIPE: the reader, such as head, has closed the pipe; click then ends silently
            if ctx.params.get("traceback") or getattr(error, "errno", None) == errno.EPIPE:
                raise
            if isinstance(error, ValueError | TypeError):
                raise UsageError(_message(error), _command_path(ctx)) from None
            raise InputError(_message(error)) from None
        except KeyboardInterrupt:
            say("interrupted")
            raise click.exceptions.Exit(INTERRUPTED) from None


def _command_path(ctx: click.Context) -> str:
    return " ".join(filter(None, (ctx.command_path, ctx.invoked_subcommand)))


@contextmanager
def exit_on_sigterm() -> Iterator[None]:
    """Exit through Python's clean-up on SIGTERM, as on Ctrl-C, so that no file is left half-written."""

    def end(*_: Any) -> None:
        sys.exit(TERMINATED)

    if threading.current_thread() is not threading.main_thread():  # only the main thread may set signal handlers
        yield
        return
    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _message(error: BaseException) -> str:
    message = str(error) or type(error).__name__
    for argument, option in OPTION_NAMES.items():
        message = message.replace(argument, option)
    return message


@click.group(
    cls=CommandGroup,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog=examples(
        "softshadow tour",
        "softshadow render volume-zfail --scene boxes",
        "softshadow pixel volume-zfail 160 170 --size 320x240",
    ),
)
@click.version_option(softshadow.__version__, "-V", "--version", prog_name="softshadow")
@click.option("--traceback", is_flag=True, help="Show the Python traceback of an error, for a bug report.")
def main(traceback: bool) -> None:
    """Real-time shadow algorithms, step by step, on a software rasterizer that explains every pixel."""


for command in (
    tour, render, steps, pixel, section, view3d, export, cards, slides, compare, replay, run, techniques, scenes,
    listings, failures, errata, lessons, check, animate, bench, sweep, warmup, doctor,
):  # fmt: skip
    main.add_command(command)


if __name__ == "__main__":
    sys.exit(main())
