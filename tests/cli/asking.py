"""The command line called inside this process, so that kernels compile once."""

import json
from typing import Any

from click.testing import CliRunner, Result

from softshadow.cli import main


def ask(*arguments: object) -> Result:
    """Return what a command answers: exit_code, stdout, stderr. No traceback may reach a user."""
    answer = CliRunner().invoke(main, [str(argument) for argument in arguments], prog_name="softshadow")
    if answer.exception is not None and not isinstance(answer.exception, SystemExit):
        raise answer.exception
    assert "Traceback" not in answer.output
    return answer


def done(*arguments: object) -> Result:
    """Return the answer of a command that has to succeed."""
    answer = ask(*arguments)
    assert answer.exit_code == 0, answer.stderr
    return answer


def as_json(*arguments: object) -> dict[str, Any]:
    """Return the JSON that a command prints, which names its form."""
    answer = json.loads(done(*arguments, "--json").stdout)
    assert answer["schema"] == f"softshadow/{arguments[0]}/1"
    return answer


def refused(*arguments: object) -> str:
    """Return the message of a command that has to refuse bad input with exit code 3 and nothing on stdout."""
    answer = ask(*arguments)
    assert answer.exit_code == 3, answer.output
    assert answer.stdout == ""
    errors = [line for line in answer.stderr.splitlines() if not line.startswith(("warning: ", "compiling "))]
    assert errors[0].startswith("error: ")
    return "\n".join(errors).removeprefix("error: ")
